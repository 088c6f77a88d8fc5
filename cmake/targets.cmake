# SPDX-License-Identifier: Apache-2.0
add_library(gnomon_options INTERFACE)
target_include_directories(gnomon_options INTERFACE ${CMAKE_SOURCE_DIR}/src ${CMAKE_SOURCE_DIR})
target_compile_definitions(gnomon_options INTERFACE VK_NO_PROTOTYPES GNOMON_VERSION_TEXT="${PROJECT_VERSION}")
if(MSVC)
  target_compile_options(gnomon_options INTERFACE /W4 /utf-8 $<$<BOOL:${GNOMON_WERROR}>:/WX>)
else()
  target_compile_options(gnomon_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wno-missing-field-initializers
                                                  $<$<BOOL:${GNOMON_WERROR}>:-Werror>)
  # GCC 12 warns of an overlap inside std::string's operator+ that cannot happen (GCC bug 105651).
  target_compile_options(gnomon_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
  if(GNOMON_SANITIZE)
    target_compile_options(gnomon_options INTERFACE -fsanitize=${GNOMON_SANITIZE} -fno-omit-frame-pointer)
    target_link_options(gnomon_options INTERFACE -fsanitize=${GNOMON_SANITIZE})
  endif()
endif()

# One static library a folder under src/; dependencies one way only (tests/unit/includes_test.cpp holds the includes to it).
function(gnomon_library name)
  cmake_parse_arguments(arg "" "" "DEPENDS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/${name}/*.cpp ${CMAKE_SOURCE_DIR}/src/${name}/*.h)
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  add_library(gnomon_${name} STATIC ${sources})
  add_library(gnomon::${name} ALIAS gnomon_${name})
  set_target_properties(gnomon_${name} PROPERTIES LINKER_LANGUAGE CXX)
  target_link_libraries(gnomon_${name} PUBLIC gnomon_options ${arg_DEPENDS})
endfunction()

function(gnomon_program name)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE gnomon_options ${arg_DEPENDS})
endfunction()

# techniques/<id>/: every folder that begins with a letter. The list is generated, so that a new folder needs no edit, and a folder
# whose .cpp forgets its constant `technique_<id>` fails to link with that name.
function(gnomon_techniques)
  file(GLOB folders CONFIGURE_DEPENDS LIST_DIRECTORIES true ${CMAKE_SOURCE_DIR}/techniques/[a-z]*)
  set(sources)
  set(list "// Generated from the folders of techniques/.\n")
  foreach(folder ${folders})
    get_filename_component(id ${folder} NAME)
    if(EXISTS ${folder}/${id}.cpp)
      file(GLOB found CONFIGURE_DEPENDS ${folder}/*.cpp)
      list(FILTER found EXCLUDE REGEX "_test\\.cpp$")
      list(APPEND sources ${found})
      string(APPEND list "GNOMON_TECHNIQUE(${id})\n")
      set_property(GLOBAL APPEND PROPERTY GNOMON_TECHNIQUE_IDS ${id})
    endif()
  endforeach()
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/techniques.inc CONTENT "${list}")
  add_library(gnomon_techniques STATIC ${sources} ${CMAKE_SOURCE_DIR}/techniques/registry.cpp)
  add_library(gnomon::techniques ALIAS gnomon_techniques)
  target_include_directories(gnomon_techniques PRIVATE ${CMAKE_BINARY_DIR}/generated)
  target_link_libraries(gnomon_techniques PUBLIC gnomon::shadow)
  # Back again for the linker alone: technique() in the one looks through the list in the other.
  target_link_libraries(gnomon_shadow INTERFACE gnomon_techniques)
endfunction()

# What engines link (docs/embedding.md): libgnomon, which shows the functions of include/gnomon/gnomon.h and nothing else.
function(gnomon_shared_library)
  add_library(gnomon_shared SHARED $<TARGET_OBJECTS:gnomon_host>)
  set_target_properties(gnomon_shared PROPERTIES OUTPUT_NAME gnomon VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
    LINKER_LANGUAGE CXX EXPORT_NAME gnomon)
  target_link_libraries(gnomon_shared PRIVATE gnomon_options gnomon::techniques)
  if(NOT APPLE AND NOT MSVC)
    # A list, and not visibility alone: instances of standard templates are visible whatever the compiler is told.
    set(map ${CMAKE_SOURCE_DIR}/cmake/package/exports.map)
    target_link_options(gnomon_shared PRIVATE -Wl,--version-script=${map} -Wl,--no-undefined)
    set_target_properties(gnomon_shared PROPERTIES LINK_DEPENDS ${map})
  endif()
endfunction()

# A text file as `inline constexpr std::string_view <name>` in the generated header <name>.h.
function(gnomon_embed_text target file name)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${file})
  file(READ ${CMAKE_SOURCE_DIR}/${file} text)
  # compilers take literals of 64 KiB at most, and join neighbours
  string(REGEX REPLACE "\n" "\n)text\"\nR\"text(" text "${text}")
  file(WRITE ${CMAKE_BINARY_DIR}/generated/${name}.h.new "#pragma once\n#include <string_view>\ninline constexpr std::string_view ${name} = R\"text(${text})text\";\n")
  file(COPY_FILE ${CMAKE_BINARY_DIR}/generated/${name}.h.new ${CMAKE_BINARY_DIR}/generated/${name}.h ONLY_IF_DIFFERENT)
endfunction()
