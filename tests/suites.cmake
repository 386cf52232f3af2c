# SPDX-License-Identifier: MIT
# ctest reads this when it starts: the GoogleTest suites of one program become tests of ctest, FOLDER.SUITE. A suite
# is one process, so that its tests share one device, what was uploaded to it and the pipelines that were compiled.
# What is instantiated once a scene, under the prefix Builtin or Asset, becomes one test a scene instead,
# FOLDER.PREFIX.SCENE, for the same reason; the suites that it runs are among its labels.
#
# Variables that this file reads: program; folder, its label and the first part of every name; seconds, how long a
# test may take; results, the folder that JUnit files are written to; costs, names and seconds of the longest, which
# start first.
if(NOT EXISTS ${program})
  add_test(${folder}.NOT_BUILT ${program})
  set_tests_properties(${folder}.NOT_BUILT PROPERTIES LABELS ${folder})
  return()
endif()
execute_process(COMMAND ${program} --gtest_list_tests OUTPUT_VARIABLE lines RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "${program} --gtest_list_tests: ${failed}")
endif()
string(REPLACE ";" "," lines "${lines}")
string(REPLACE "\n" ";" lines "${lines}")

set(groups "")
foreach(line IN LISTS lines)
  if(line MATCHES "^([^ ]+)\\.( |$)")
    set(suite ${CMAKE_MATCH_1})
    string(REGEX REPLACE "^.*/" "" short ${suite})
  elseif(line MATCHES "^  ([^ ]+)")
    set(name ${CMAKE_MATCH_1})
    if(suite MATCHES "^(Builtin|Asset)/" AND name MATCHES "/(.+)$")
      set(scene ${CMAKE_MATCH_1})
      string(REGEX MATCH "^[A-Za-z]+" kind ${suite})
      set(group ${folder}.${kind}.${scene})
      list(APPEND filter_${group} ${suite}.${name})
      list(APPEND labels_${group} ${short})
    else()
      set(group ${folder}.${short})
      list(APPEND filter_${group} ${suite}.*)
    endif()
    list(APPEND groups ${group})
  endif()
endforeach()
list(REMOVE_DUPLICATES groups)

foreach(group IN LISTS groups)
  list(REMOVE_DUPLICATES filter_${group})
  list(REMOVE_DUPLICATES labels_${group})
  list(JOIN filter_${group} ":" filter)
  add_test(${group} ${program} --gtest_filter=${filter} --gtest_output=xml:${results}/${group}.xml)
  set(cost 0)
  list(FIND costs ${group} at)
  if(at GREATER -1)
    math(EXPR at "${at} + 1")
    list(GET costs ${at} cost)
  endif()
  set_tests_properties(${group} PROPERTIES LABELS "${folder};${labels_${group}}" TIMEOUT ${seconds} COST ${cost})
endforeach()
