# cmake -D root=<source folder> -P includes.cmake
#
# Fails where an include points against the flow constraints -> core, solvers -> core, or where a header
# of SUNDIALS, SuiteSparse or solvers/private leaves the sources of solvers.

set(not_from_core constraints models solvers)
set(not_from_constraints models solvers)
set(not_from_solvers constraints models)
set(inner "(sundials|ida|arkode|nvector|sunlinsol|sunmatrix|sunnonlinsol)/"
          "(suitesparse/)?(klu|amd|colamd|btf|ldl|SuiteSparse_config)\\.h"
          "(dalembert/solvers/)?private/")
list(JOIN inner "|" inner)

function(forbid file what regex)
  file(STRINGS ${file} lines REGEX "^[ \t]*#[ \t]*include[ \t]*${regex}")
  foreach(line IN LISTS lines)
    file(RELATIVE_PATH name ${root} ${file})
    message(SEND_ERROR "${name}: ${what} must not be included here: ${line}")
  endforeach()
endfunction()

foreach(room core constraints solvers)
  file(GLOB_RECURSE files ${root}/${room}/*.h ${root}/${room}/*.cpp)
  list(JOIN not_from_${room} "|" others)
  foreach(file IN LISTS files)
    forbid(${file} "another room" "[<\"](dalembert/|\\.\\./)*((${others})/|dalembert\\.h)")
  endforeach()
endforeach()

file(GLOB files ${root}/dalembert.h ${root}/core/* ${root}/constraints/* ${root}/models/* ${root}/solvers/*.h)
foreach(file IN LISTS files)
  forbid(${file} "a SUNDIALS, SuiteSparse or private header" "[<\"](${inner})")
endforeach()
