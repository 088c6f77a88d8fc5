# SPDX-License-Identifier: Apache-2.0
# Builds examples/host_engine as its readers do: in a copy of its folder, against PREFIX.
include(${CMAKE_CURRENT_LIST_DIR}/demand.cmake)
file(MAKE_DIRECTORY ${FOLDER})
file(COPY ${SOURCE}/examples/host_engine DESTINATION ${FOLDER})
demand(${CMAKE_COMMAND} -S ${FOLDER}/host_engine -B ${FOLDER}/build -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${PREFIX} -DCMAKE_COMPILE_WARNING_AS_ERROR=ON ${OPTIONS})
demand(${CMAKE_COMMAND} --build ${FOLDER}/build)
