# SPDX-License-Identifier: Apache-2.0
# Run at install time with `programs` and `loader` set (bundle.cmake): copies the libraries of the programs.
file(GET_RUNTIME_DEPENDENCIES EXECUTABLES ${programs} RESOLVED_DEPENDENCIES_VAR libraries
     PRE_EXCLUDE_REGEXES "^(ld-linux.*|libc|libm|libdl|librt|libpthread)\\.so")
foreach(library ${libraries} ${loader})
  get_filename_component(name ${library} NAME)
  set(folder ${CMAKE_INSTALL_PREFIX}/lib)
  if(name MATCHES "^(libstdc\\+\\+|libgcc_s|libz|libvulkan|libX11|libxcb|libXau|libXdmcp|libbsd|libmd)\\.so")
    string(APPEND folder /fallback/${name})
  endif()
  file(INSTALL ${library} DESTINATION ${folder} TYPE SHARED_LIBRARY FOLLOW_SYMLINK_CHAIN)
endforeach()
