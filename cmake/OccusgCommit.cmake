# SPDX-License-Identifier: BSD-3-Clause
# Writes a source file that defines occusg::apps::kCommit, the commit of the sources; empty when they are no git clone.
# Usage: cmake -DSOURCE=FOLDER -DRESULT=FILE -P OccusgCommit.cmake
set(commit "")
find_program(git git)
if(git AND EXISTS "${SOURCE}/.git")
  execute_process(
    COMMAND "${git}" -C "${SOURCE}" describe --always --dirty --exclude *
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
set(text "namespace occusg::apps {
extern const char* const kCommit;
const char* const kCommit = \"${commit}\";
}  // namespace occusg::apps
")
set(known "")
if(EXISTS "${RESULT}")
  file(READ "${RESULT}" known)
endif()
if(NOT text STREQUAL known)
  file(WRITE "${RESULT}" "${text}")
endif()
