# ghostlight_sources(<variable> <pattern>...): the matching files below the current folder. A file
# that appears or goes is noticed by the next build, so adding one needs no edit of a list.
function(ghostlight_sources variable)
    list(TRANSFORM ARGN PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/")
    file(GLOB_RECURSE found CONFIGURE_DEPENDS ${ARGN})
    set(${variable} ${found} PARENT_SCOPE)
endfunction()
