# SPDX-License-Identifier: MIT
#
# cmake --install: the tools, and the client library as find_package(selvage) finds it (components tools, client).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS selvage-server selvage-pack selvage-client selvage-load
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tools)

# What programs link: selvage::client. The rest is what it is made of.
add_library(selvage_client INTERFACE)
set_target_properties(selvage_client PROPERTIES EXPORT_NAME client)
target_link_libraries(selvage_client INTERFACE selvage_fetch)
target_include_directories(selvage_client INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)

install(TARGETS selvage_client selvage_fetch selvage_http selvage_part_cache selvage_client_session selvage_answers
    selvage_stitch selvage_decode selvage_net selvage_wire selvage_proto selvage_pack_format selvage_codec
    selvage_coding selvage_mesh selvage_base selvage_options
  EXPORT selvage-targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/selvage COMPONENT client)
install(EXPORT selvage-targets NAMESPACE selvage:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/selvage COMPONENT client)

set(selvage_public_headers client/fetch/model.h client/fetch/live_model.h client/fetch/list_models.h)
install(CODE "
  set(selvage_source \"${PROJECT_SOURCE_DIR}\")
  set(selvage_public_headers \"${selvage_public_headers}\")
  set(selvage_include_folder \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}/selvage\")
  include(\"${PROJECT_SOURCE_DIR}/cmake/install_headers.cmake\")" COMPONENT client)

configure_package_config_file(cmake/selvage-config.cmake.in ${CMAKE_BINARY_DIR}/selvage-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/selvage)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/selvage-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/selvage-config.cmake ${CMAKE_BINARY_DIR}/selvage-config-version.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/selvage COMPONENT client)
