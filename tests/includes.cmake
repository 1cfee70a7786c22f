# cmake -D root=<source folder> -P includes.cmake
#
# The rooms from the ground up: fails where a file includes one from a room further down this list, where the
# solvers know a constraint, and where a header that users include needs Eigen, or one of SUNDIALS, SuiteSparse or
# of the solvers' own.

set(rooms core core/autodiff core/points core/equations core/forces core/results core/scene core/linear core/analysis core/lagrange
          constraints/geometry constraints constraints/bodies constraints/joints
          solvers/base solvers/audit solvers/linear solvers/manifold solvers/contact solvers/run solvers/ida solvers/erk solvers solvers/certificate solvers/equilibrium solvers/lagrange view sweep testing)
set(public "solvers/base/options|solvers/integrator|solvers/simulation|solvers/certificate/(certificate|largest_errors|report|simulate_to|two_runs|work_precision)|solvers/equilibrium/(branches|equilibrium|floquet|normal_modes|steady|steady_branches|uniform_rotation)|solvers/lagrange/(cross_check|lagrangian_simulation)|view/write_(gltf|html)|sweep/(parameters|runs|sweep|write_hdf5)")
set(theirs "(sundials|ida|nvector|sunlinsol|sunmatrix|sunnonlinsol)/|(suitesparse/)?(klu|amd|colamd|btf|ldl|hdf5|mpi)\\.h|(boost|tbb|oneapi)/")

foreach(room IN LISTS rooms)
  list(FIND rooms ${room} place)
  file(GLOB files RELATIVE ${root} ${root}/${room}/*.h ${root}/${room}/*.cpp)
  if(NOT files)
    message(SEND_ERROR "${room}: no such room")
  endif()
  foreach(file IN LISTS files)
    set(for_users FALSE)
    if(file MATCHES "^(core|constraints|models|testing)/|^(${public})\\.h")
      set(for_users TRUE)
    endif()
    file(STRINGS ${root}/${file} lines REGEX "^[ \t]*#[ \t]*include")
    foreach(line IN LISTS lines)
      if(for_users AND line MATCHES "[<\"](${theirs})")
        message(SEND_ERROR "${file}: users do not have ${line}")
      endif()
      if(file MATCHES "^(core|constraints)/.*\\.h$|^(${public})\\.h$" AND NOT file MATCHES "^core/(analysis/rank|linear/(dense|products))\\.h$"
         AND line MATCHES "<Eigen/")
        message(SEND_ERROR "${file}: Eigen costs each of a user's files half a second; include it in a .cpp: ${line}")
      endif()
      if(line MATCHES "\"" AND NOT line MATCHES "\"dalembert/"
         OR line MATCHES "dalembert/dalembert\\.h" AND NOT room STREQUAL models)
        message(SEND_ERROR "${file}: name the file of the room that is meant: ${line}")
      endif()
      if(NOT line MATCHES "[<\"]dalembert/((.*)/[^/]+)\\.h")
        continue()
      endif()
      set(header ${CMAKE_MATCH_1})
      set(other ${CMAKE_MATCH_2})
      list(FIND rooms ${other} other_place)
      if(other_place EQUAL -1 OR other_place GREATER place OR "${room} ${other}" MATCHES "^solvers.* constraints")
        message(SEND_ERROR "${file}: another room must not be included here: ${line}")
      endif()
      if(for_users AND header MATCHES "^solvers/" AND NOT header MATCHES "^(${public})$")
        message(SEND_ERROR "${file}: users do not have ${line}")
      endif()
    endforeach()
  endforeach()
endforeach()
