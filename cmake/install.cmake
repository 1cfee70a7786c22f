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
# Sweeps are a component with engines of its own: who does not ask for it needs none of them.
if(TARGET dalembert-sweep)
  install(TARGETS dalembert-sweep EXPORT dalembert-sweep FILE_SET HEADERS)
  install(EXPORT dalembert-sweep NAMESPACE dalembert:: FILE dalembertSweepTargets.cmake DESTINATION ${package_dir})
endif()
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

# For pkg-config; found from its own place, so that the package may be moved. What a static library is linked
# with stands among `Libs`, as its users do not ask for --static.
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX BASE_DIRECTORY ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig OUTPUT_VARIABLE pc_prefix)
set(pc_solvers "-lsundials_ida -lsundials_nvecserial -lklu -lbtf -lcolamd -lldl -lamd -lsuitesparseconfig -lm")
if(SUNDIALS_VERSION VERSION_GREATER_EQUAL 7)
  string(REPLACE "nvecserial" "nvecserial -lsundials_core" pc_solvers "${pc_solvers}")
endif()
cmake_path(GET SUNDIALS_DIR PARENT_PATH pc_sundials) # <where its libraries are>/cmake/sundials
cmake_path(GET pc_sundials PARENT_PATH pc_sundials)
if(NOT pc_sundials IN_LIST CMAKE_CXX_IMPLICIT_LINK_DIRECTORIES)
  string(PREPEND pc_solvers "-L${pc_sundials} ")
endif()
if(NOT BUILD_SHARED_LIBS)
  set(pc_libs " ${pc_solvers}")
endif()
configure_file(cmake/dalembert.pc.in ${PROJECT_BINARY_DIR}/dalembert.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/dalembert.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
