# Flags that every target here takes, and the rule that dependencies point down.

# Everything built here, and nothing that merely links to it, takes these flags.
add_library(palp_flags INTERFACE)
target_compile_options(palp_flags INTERFACE
  -Wall -Wextra -Wshadow -Wconversion $<$<BOOL:${PALP_WERROR}>:-Werror>)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # gcc 12 sees copies beyond the end in a sum of strings, by the length of a literal such as the path
  # of the sources (its bug 105651)
  target_compile_options(palp_flags INTERFACE -Wno-error=array-bounds -Wno-error=restrict
    -Wno-error=stringop-overflow -Wno-error=stringop-overread)
endif()
if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
  target_compile_options(palp_flags INTERFACE -Wno-sign-conversion) # which g++ does not count to it
endif()
if(NOT PALP_SANITIZE)
  # what a damaged file could do to a reader ends the process instead
  target_compile_options(palp_flags INTERFACE -fstack-protector-strong
    $<$<CONFIG:Release>:-U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2>)
  target_link_options(palp_flags INTERFACE -Wl,-z,relro,-z,now)
endif()
if(PALP_SANITIZE)
  # gcc 12 sees values unset in instrumented code that are not
  target_compile_options(palp_flags INTERFACE -fsanitize=${PALP_SANITIZE} -fno-omit-frame-pointer
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_compile_definitions(palp_flags INTERFACE PALP_SANITIZED)
  target_link_options(palp_flags INTERFACE -fsanitize=${PALP_SANITIZE})
  if(PALP_SANITIZE MATCHES undefined)
    # half of the time to compile, for what AddressSanitizer finds as well (pointers that are null or
    # leave their object), and for an alignment that no cast of ours can break: all of them are to bytes
    target_compile_options(palp_flags INTERFACE -fno-sanitize=null,alignment,object-size,pointer-overflow)
  endif()
endif()

# palp_library(<name> SOURCES <file>... [PUBLIC <library>...] [PRIVATE <library>...])
#
# The library of the calling folder. PUBLIC is what its headers include, PRIVATE what only its sources do.
function(palp_library name)
  cmake_parse_arguments(PARSE_ARGV 1 palp "" "" "SOURCES;PUBLIC;PRIVATE")
  set(target palp_${name})
  add_library(${target} STATIC ${palp_SOURCES})
  add_library(palp::${name} ALIAS ${target})
  # classes of VTK's dialect are checked by rules of their own, so each is compiled by itself
  list(FILTER palp_SOURCES INCLUDE REGEX "\\.cxx$")
  set_source_files_properties(${palp_SOURCES} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:include/palp>)
  target_link_libraries(${target}
    PUBLIC ${palp_PUBLIC}
    PRIVATE ${palp_PRIVATE} $<BUILD_INTERFACE:palp_flags>)
endfunction()

# palp_group(<name> <library>...): palp::<name> stands for several libraries.
function(palp_group name)
  add_library(palp_${name} INTERFACE)
  add_library(palp::${name} ALIAS palp_${name})
  target_link_libraries(palp_${name} INTERFACE ${ARGN})
endfunction()

# palp_install(<component> <library>...): libraries and headers that others find as a component of the
# package Palp; palp::<component> is a group. The folder of the headers has the component's name.
function(palp_install component)
  list(TRANSFORM ARGN REPLACE "^palp::" "palp_")
  foreach(target palp_${component} ${ARGN})
    string(REPLACE "palp_" "" name ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  endforeach()
  install(TARGETS palp_${component} ${ARGN} EXPORT palp_${component} ARCHIVE DESTINATION lib/palp)
  install(EXPORT palp_${component} NAMESPACE palp:: FILE Palp_${component}.cmake
    DESTINATION lib/cmake/Palp)
  foreach(target ${ARGN})
    get_target_property(directory ${target} SOURCE_DIR)
    get_target_property(headers ${target} SOURCES)
    list(FILTER headers INCLUDE REGEX "\\.h$")
    file(RELATIVE_PATH place ${PROJECT_SOURCE_DIR} ${directory})
    foreach(header ${headers}) # some in folders below
      get_filename_component(below ${header} DIRECTORY)
      install(FILES ${directory}/${header} DESTINATION include/palp/${place}/${below})
    endforeach()
  endforeach()
endfunction()

# palp_forbid(<target> <regex>): stop the configuration if a target links against a
# library that its layer must not know.
function(palp_forbid target pattern)
  get_target_property(libraries ${target} LINK_LIBRARIES)
  foreach(library IN LISTS libraries)
    if(library MATCHES "${pattern}")
      message(FATAL_ERROR "${target} must not link ${library}: dependencies point down, "
        "app -> pipeline -> calibration -> haptics -> Eigen")
    endif()
  endforeach()
endfunction()
