# Flags that every target here takes, and the rule that dependencies point down.

# Everything built here, and nothing that merely links to it, takes these flags.
add_library(palp_flags INTERFACE)
target_compile_options(palp_flags INTERFACE
  -Wall -Wextra -Wshadow -Wconversion $<$<BOOL:${PALP_WERROR}>:-Werror>)
if(NOT PALP_SANITIZE)
  # what a damaged file could do to a reader ends the process instead
  target_compile_options(palp_flags INTERFACE -fstack-protector-strong
    $<$<CONFIG:Release>:-U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2>)
  target_link_options(palp_flags INTERFACE -Wl,-z,relro,-z,now)
endif()
if(PALP_SANITIZE)
  # gcc 12 sees values unset in instrumented code that are not
  target_compile_options(palp_flags INTERFACE -fsanitize=${PALP_SANITIZE} -fno-omit-frame-pointer
    -Wno-maybe-uninitialized)
  target_link_options(palp_flags INTERFACE -fsanitize=${PALP_SANITIZE})
endif()

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
