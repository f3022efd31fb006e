# SPDX-License-Identifier: BSD-3-Clause
# Language level, warnings and sanitizers shared by every target of the project.

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  message(STATUS "No build type given: Release")
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
include(CheckPIESupported)
check_pie_supported(LANGUAGES CXX)

add_library(occusg_compile_options INTERFACE)
target_compile_options(occusg_compile_options INTERFACE -Wall -Wextra -Wpedantic)
# gcc 12 warns about operator+ of std::string in its own library (GCC bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 12
   AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(occusg_compile_options INTERFACE -Wno-restrict)
endif()
if(OCCUSG_WARNINGS_AS_ERRORS)
  target_compile_options(occusg_compile_options INTERFACE -Werror)
endif()
if(OCCUSG_SANITIZE)
  add_compile_options(-fsanitize=${OCCUSG_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${OCCUSG_SANITIZE})
endif()

# Hardening of what users run. Fortification needs optimisation; a distribution may define it already.
if(CMAKE_BUILD_TYPE STREQUAL "Release" AND NOT OCCUSG_SANITIZE)
  add_compile_options(-fstack-protector-strong -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2
    -D_GLIBCXX_ASSERTIONS)
  add_link_options(-Wl,-z,relro -Wl,-z,now)
endif()

# Where a target looks for libraries, in the build tree and installed alike. CMake would end a RUNPATH
# that it replaces on installation with a colon, which stands for the current folder.
function(occusg_set_rpath target)
  set_target_properties(${target} PROPERTIES INSTALL_RPATH "${ARGN}" BUILD_WITH_INSTALL_RPATH ON)
endfunction()

# Compiles the files of a target in batches when OCCUSG_UNITY_BUILD is ON. Files named after ALONE have
# local names that another file of the target has too and are compiled on their own.
function(occusg_allow_batches target)
  cmake_parse_arguments(arg "" "" "ALONE" ${ARGN})
  if(NOT OCCUSG_UNITY_BUILD)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  set_source_files_properties(${arg_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
