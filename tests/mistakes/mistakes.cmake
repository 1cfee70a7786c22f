# cmake -D compiler=<path> -D "includes=<folders>" -D source=<mistakes.cpp> -D folder=<to work in> -P mistakes.cmake
#
# Fails unless the source compiles, but not with any of its mistakes: `#ifdef MISTAKE_...  // <sentence>` must
# put the sentence into the first ten lines of what the compiler says; the source that it quotes, as g++ 14 does
# for every template on the way, counts with the line that it stands below.

list(TRANSFORM includes PREPEND -I)
set(compile ${compiler} -std=c++20 ${includes})

# The headers, which all compilations share, are read once.
file(STRINGS ${source} headers REGEX "^#include")
list(JOIN headers "\n" headers)
file(WRITE ${folder}/headers.h "${headers}\n")
execute_process(COMMAND ${compile} -x c++-header ${folder}/headers.h -o ${folder}/headers.h.gch COMMAND_ERROR_IS_FATAL ANY)
list(APPEND compile -fsyntax-only -include ${folder}/headers.h ${source})

execute_process(COMMAND ${compile} RESULT_VARIABLE failed ERROR_VARIABLE said)
if(failed)
  message(FATAL_ERROR "without a mistake:\n${said}")
endif()

set(wrong OFF)
file(STRINGS ${source} mistakes REGEX "^#ifdef MISTAKE")
foreach(line IN LISTS mistakes)
  string(REGEX MATCH "^#ifdef ([A-Za-z_]+)  // (.*)$" matched "${line}")
  set(mistake ${CMAKE_MATCH_1})
  set(sentence "${CMAKE_MATCH_2}")
  execute_process(COMMAND ${compile} -D${mistake} RESULT_VARIABLE failed ERROR_VARIABLE said)
  string(REGEX REPLACE "\n( +[0-9]* *\\|)" "\\1" said "${said}")
  string(REGEX MATCH "^([^\n]*\n?[^\n]*\n?[^\n]*\n?[^\n]*\n?[^\n]*\n?[^\n]*\n?[^\n]*\n?[^\n]*\n?[^\n]*\n?[^\n]*)" first "${said}")
  string(FIND "${first}" "${sentence}" place)
  if(NOT failed OR place EQUAL -1)
    message("${mistake} must be refused with \"${sentence}\" in the first ten lines, which are:\n${first}\n")
    set(wrong ON)
  endif()
endforeach()
if(wrong)
  message(FATAL_ERROR "see above")
endif()
