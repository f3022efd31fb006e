# SPDX-License-Identifier: BSD-3-Clause
# Writes a header that defines OCCUSG_COMMIT as the commit of the sources, empty when they are no git clone.
# Usage: cmake -DSOURCE=FOLDER -DHEADER=FILE -P OccusgCommit.cmake
set(commit "")
find_program(git git)
if(git AND EXISTS "${SOURCE}/.git")
  execute_process(
    COMMAND "${git}" -C "${SOURCE}" describe --always --dirty --exclude *
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
set(text "#pragma once\n#define OCCUSG_COMMIT \"${commit}\"\n")
set(known "")
if(EXISTS "${HEADER}")
  file(READ "${HEADER}" known)
endif()
if(NOT text STREQUAL known)
  file(WRITE "${HEADER}" "${text}")
endif()
