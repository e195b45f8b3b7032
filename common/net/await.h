// SPDX-License-Identifier: MIT
//
// How coroutines here await an Asio operation: failure comes back as an error_code, not as an exception.
//
//     auto [error, count] = co_await socket.async_read_some(buffer, kAwait);
#pragma once

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/use_awaitable.hpp>

namespace selvage {

inline constexpr boost::asio::as_tuple_t<boost::asio::use_awaitable_t<>> kAwait{boost::asio::use_awaitable};

}  // namespace selvage
