# find_at_least(<package> <version> [options of find_package])
#
# Requires a package of this version or any later one. find_package refuses a later major version where the
# package's own version file says so, as those of Eigen 5 and SUNDIALS 7 do. (A macro, so that what
# find_package sets reaches the caller.)
macro(find_at_least package version)
  find_package(${package} CONFIG REQUIRED ${ARGN})
  if(${package}_VERSION VERSION_LESS ${version})
    message(FATAL_ERROR "${package} ${${package}_VERSION} in ${${package}_DIR} is too old: at least ${version} is needed")
  endif()
endmacro()
