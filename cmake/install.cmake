include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/dalembert)

install(TARGETS dalembert EXPORT dalembert FILE_SET HEADERS)
install(EXPORT dalembert NAMESPACE dalembert:: FILE dalembertTargets.cmake DESTINATION ${package_dir})

configure_package_config_file(cmake/dalembertConfig.cmake.in ${PROJECT_BINARY_DIR}/dalembertConfig.cmake
                              INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/dalembertConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/dalembertConfig.cmake ${PROJECT_BINARY_DIR}/dalembertConfigVersion.cmake
              cmake/FindKLU.cmake cmake/FindLDL.cmake
        DESTINATION ${package_dir})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
