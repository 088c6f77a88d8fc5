# SPDX-License-Identifier: Apache-2.0
# demand(COMMAND...): runs it, and fails with all that it said unless it ends well; `text` is then what it said.
cmake_minimum_required(VERSION 3.25)
macro(demand)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " line)
    message(FATAL_ERROR "${line} ended with ${result}:\n${text}")
  endif()
endmacro()
