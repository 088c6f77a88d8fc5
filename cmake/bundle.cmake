# SPDX-License-Identifier: Apache-2.0
# What `./dev bundle` packs, as install components: a program, a launcher, and the libraries it needs except glibc's.
#
# A library that a Vulkan driver may load too goes to lib/fallback/<its name>/, which the launcher uses only where the system has
# none: with an older libstdc++ already in the process, a driver built by a newer compiler would not load.
function(gnomon_bundle component)
  set(files)
  foreach(target ${ARGN})
    # DT_RPATH, not DT_RUNPATH: it also serves the libraries' own libraries (Embree's TBB).
    target_link_options(${target} PRIVATE -Wl,--disable-new-dtags)
    set_target_properties(${target} PROPERTIES INSTALL_RPATH "$ORIGIN/../lib")
    list(APPEND files $<TARGET_FILE:${target}>)
  endforeach()
  install(TARGETS ${ARGN} RUNTIME DESTINATION bin COMPONENT ${component} EXCLUDE_FROM_ALL)
  install(CODE "set(programs \"${files}\")\nset(loader \"${Vulkan_LIBRARY}.1\")" COMPONENT ${component} EXCLUDE_FROM_ALL)
  install(SCRIPT ${CMAKE_SOURCE_DIR}/cmake/bundle_libraries.cmake COMPONENT ${component} EXCLUDE_FROM_ALL)
endfunction()

if(CMAKE_SYSTEM_NAME STREQUAL Linux)
  if(TARGET gnomon)
    gnomon_bundle(bundle gnomon)
    install(PROGRAMS cmake/bundle_launcher.sh DESTINATION . RENAME gnomon COMPONENT bundle EXCLUDE_FROM_ALL)
  endif()
  if(GNOMON_TESTS)
    get_property(test_targets DIRECTORY tests PROPERTY BUILDSYSTEM_TARGETS)
    list(FILTER test_targets INCLUDE REGEX "_tests$")
    if(test_targets)
      gnomon_bundle(bundle_tests ${test_targets})
      install(PROGRAMS cmake/bundle_launcher.sh DESTINATION . RENAME run_tests COMPONENT bundle_tests EXCLUDE_FROM_ALL)
    endif()
  endif()
endif()
