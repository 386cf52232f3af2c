# SPDX-License-Identifier: MIT
# ctest reads this at start, once per program. It makes ctest tests FOLDER.1, FOLDER.2 ... of GoogleTest
# suites. Each runs neighbouring suites in one process (group.sh), which share a device, pipelines and
# uploaded scenes.
#
# Environment, set by ./diptych test; without it everything runs:
#   DIPTYCH_TIER=default   skips the tests of longer.txt
#   DIPTYCH_CAMPAIGN=1     every test, with optimised shaders. Otherwise one in four of the lines `campaign:` of
#     longer.txt, those that DIPTYCH_SEED (1) selects, or those that are asked for by name
#   DIPTYCH_TESTS=NAME     only names that contain NAME: FOLDER.SUITE or FOLDER.SUITE.TEST, a process each
#
# Variables:
#   program, folder (its label), results (folder of JUnit files), here (folder of this file)
#   seconds: limit of a process
#   processes: number of processes that share the suites; 0: one for each suite
#   validated: suites under the validation layers, in four further processes; all if empty. Others set
#     DIPTYCH_VALIDATE=0. Lavapipe optimises shaders of these suites alone, and none in the default tier: small
#     images take it longer to compile than to draw (MEASURED.md).
#   validated_by_all: further such suites, but in the default tier
#   costs: names and seconds of the longest, which start first
if(NOT EXISTS ${program})
  add_test(${folder}.NOT_BUILT ${program})
  set_tests_properties(${folder}.NOT_BUILT PROPERTIES LABELS ${folder})
  return()
endif()

# glibc keeps freed memory for the next shader, in huge pages: lavapipe's compiler frees much of it.
set(environment MALLOC_TRIM_THRESHOLD_=2000000000 MALLOC_MMAP_MAX_=0 MALLOC_TOP_PAD_=67108864
  GLIBC_TUNABLES=glibc.malloc.hugetlb=1)
set(left_out "")
file(STRINGS ${here}/longer.txt waiting REGEX "^${folder}\\.")
if(NOT "$ENV{DIPTYCH_TIER}" STREQUAL default)
  list(APPEND validated ${validated_by_all})
  list(FILTER waiting INCLUDE REGEX " campaign: ")
  if("$ENV{DIPTYCH_CAMPAIGN}" MATCHES "^0?$" AND "$ENV{DIPTYCH_TESTS}" STREQUAL "")
    set(row "$ENV{DIPTYCH_SEED}")
    if(NOT row)
      set(row 1)
    endif()
  else()
    set(waiting "")
  endif()
endif()
foreach(line IN LISTS waiting)
  if(DEFINED row)
    math(EXPR row "${row} + 1")
    math(EXPR turn "${row} % 4")
    if(turn EQUAL 0)
      continue()
    endif()
  endif()
  string(REGEX REPLACE "^[^.]*\\.([^ ]*).*$" "\\1" pattern ${line})
  string(APPEND left_out ":${pattern}")
endforeach()
string(REGEX REPLACE "^:" "-" left_out "${left_out}")
execute_process(COMMAND ${program} --gtest_list_tests --gtest_filter=*${left_out}
  OUTPUT_VARIABLE lines RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "${program} --gtest_list_tests: ${failed}")
endif()
string(REPLACE ";" "," lines "${lines}")
string(REPLACE "\n" ";" lines "${lines}")

set(names "")
macro(run_in name pattern)
  list(APPEND names ${name})
  list(APPEND filter_${name} ${pattern})
  if(validated AND is_validated EQUAL -1)
    set(validate_${name} DIPTYCH_VALIDATE=0)
  endif()
  if("$ENV{DIPTYCH_TIER}" STREQUAL default OR is_validated EQUAL -1 AND "$ENV{DIPTYCH_CAMPAIGN}" MATCHES "^0?$")
    set(compile_${name} GALLIVM_PERF=nopt)
  endif()
endmacro()

set(suites ${lines})
list(FILTER suites INCLUDE REGEX "^[^ ]+\\.( |$)")
list(LENGTH suites count)
set(at 0)
foreach(line IN LISTS lines)
  if(line MATCHES "^([^ ]+)\\.( |$)")
    set(suite ${CMAKE_MATCH_1})
    string(REGEX REPLACE "^.*/" "" short ${suite})
    math(EXPR at "${at} + 1")
    string(FIND ${folder}.${short} "$ENV{DIPTYCH_TESTS}" suite_is_asked)
    list(FIND validated "${short}" is_validated)
    if(suite_is_asked EQUAL -1)
      continue()
    elseif(processes EQUAL 0 OR NOT "$ENV{DIPTYCH_TESTS}" STREQUAL "")
      run_in(${folder}.${short} ${suite}.*)
    elseif(is_validated GREATER -1)
      math(EXPR number "(${at} - 1) * 4 / ${count} + 1")
      run_in(${folder}.validated.${number} ${suite}.*)
    else()
      math(EXPR number "(${at} - 1) * ${processes} / ${count} + 1")
      run_in(${folder}.${number} ${suite}.*)
    endif()
  elseif(line MATCHES "^  ([^ ]+)" AND suite_is_asked EQUAL -1)
    set(test ${folder}.${short}.${CMAKE_MATCH_1})
    string(FIND ${test} "$ENV{DIPTYCH_TESTS}" test_is_asked)
    if(test_is_asked GREATER -1)
      string(REPLACE / . test ${test})  # of a parameterized test
      run_in(${test} ${suite}.${CMAKE_MATCH_1})
    endif()
  endif()
endforeach()
list(REMOVE_DUPLICATES names)

foreach(name IN LISTS names)
  list(JOIN filter_${name} ":" filter)
  add_test(${name} ${here}/group.sh ${program} ${filter}${left_out} ${results}/${name})
  set(cost 0)
  list(FIND costs ${name} at)
  if(at GREATER -1)
    math(EXPR at "${at} + 1")
    list(GET costs ${at} cost)
  elseif(processes)
    set(cost 50)
  endif()
  set_tests_properties(${name} PROPERTIES LABELS ${folder} TIMEOUT ${seconds} COST ${cost}
    ENVIRONMENT "${environment};${validate_${name}};${compile_${name}}")
endforeach()
