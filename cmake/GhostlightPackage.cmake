# What `cmake --install` puts where besides the programs, and the Debian package that CPack makes
# of it. Paths are relative to the prefix: the programs find lenses and docs beside themselves
# (data_directory()), wherever that is.

# Packing builds nothing: ./dev package has built the programs, and tests are not in it.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
set(id io.github.ghostlight.Ghostlight)

install(DIRECTORY lenses/ DESTINATION share/ghostlight/lenses)
install(DIRECTORY docs/ DESTINATION share/ghostlight/docs)
install(FILES LICENSE DESTINATION share/doc/ghostlight RENAME copyright)
if(TARGET ghostlight)
    install(FILES app/install/${id}.desktop DESTINATION share/applications)
    install(FILES app/install/${id}.svg DESTINATION share/icons/hicolor/scalable/apps)
    install(FILES app/install/ghostlight.xml DESTINATION share/mime/packages)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME ghostlight)
set(CPACK_PACKAGE_VENDOR "The Ghostlight authors")
set(CPACK_PACKAGE_CONTACT "The Ghostlight authors <ghostlight@users.noreply.github.com>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "workbench for the flare and ghosts of photographic lenses")
set(CPACK_PACKAGE_DESCRIPTION
    "Opens real lenses, shows their layout, the paths of their ghosts, the flare on
 the sensor and the table of every ghost, all following each edit. Reads Zemax,
 CODE V, OSLO and other formats, and fits coatings to photographs of flare. The
 command line gives the same numbers as the window."
)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_SOURCE_DIR}/out)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# The libraries by what the programs link; the rest is loaded by name at run time: the
# reader of SVG pictures, a software OpenGL for machines without a card, the typeface that the
# window is drawn for, and the texts of Qt's own dialogs in other languages.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libqt6svg6")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libgl1-mesa-dri, fonts-inter, qt6-translations-l10n")
include(CPack)
