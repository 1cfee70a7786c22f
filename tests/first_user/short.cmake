# cmake -D "programs=<files>" -P short.cmake
#
# Fails where a program has 25 lines or more.

foreach(program IN LISTS programs)
  file(READ ${program} text)
  string(REGEX MATCHALL "\n" ends "${text}")
  list(LENGTH ends count)
  if(count GREATER_EQUAL 25)
    message(SEND_ERROR "${program} has ${count} lines; a wish takes fewer than 25")
  endif()
endforeach()
