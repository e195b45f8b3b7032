# SPDX-License-Identifier: MIT
#
# Copies the public headers, and all of ours that they include, to selvage_include_folder. A header keeps its place:
# client/fetch/model.h becomes <selvage/client/fetch/model.h>, and so do the includes in it, so that none of them can
# be taken for a header of the program that uses us.
cmake_minimum_required(VERSION 3.25)

set(waiting ${selvage_public_headers})
set(done)
while(waiting)
  list(POP_FRONT waiting header)
  if(header IN_LIST done)
    continue()
  endif()
  list(APPEND done ${header})
  file(STRINGS "${selvage_source}/${header}" includes REGEX "^#include \"")
  foreach(line IN LISTS includes)
    string(REGEX REPLACE "^#include \"([^\"]+)\".*" "\\1" included "${line}")
    list(APPEND waiting "${included}")
  endforeach()
  file(READ "${selvage_source}/${header}" text)
  string(REGEX REPLACE "#include \"(client|common)/" "#include \"selvage/\\1/" text "${text}")
  file(WRITE "${selvage_include_folder}/${header}" "${text}")
endwhile()
