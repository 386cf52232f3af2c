# SPDX-License-Identifier: MIT
# Given to CMake as CMAKE_PROJECT_INCLUDE by mutate.py: the product's sources are compiled one by one, so that an edit
# recompiles one of them; those of the tests, which no edit touches, stay together (DIPTYCH_UNITY).
function(diptych_sources_alone folder)
  get_directory_property(targets DIRECTORY ${folder} BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    if(NOT target MATCHES "_tests$")
      set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)
    endif()
  endforeach()
  get_directory_property(folders DIRECTORY ${folder} SUBDIRECTORIES)
  foreach(subfolder IN LISTS folders)
    diptych_sources_alone(${subfolder})
  endforeach()
endfunction()
cmake_language(DEFER CALL diptych_sources_alone ${CMAKE_CURRENT_SOURCE_DIR})
