// SPDX-License-Identifier: MIT
//
// The one compilation of Asio's non-template parts: see BOOST_ASIO_SEPARATE_COMPILATION in CMakeLists.txt.
#include <boost/asio/impl/src.hpp>
