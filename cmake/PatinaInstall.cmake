# Where everything goes on a system, and the Debian package (scripts/package).
install(TARGETS patina patina-editor RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
# Started by the other two, never by hand.
install(TARGETS patina-model-worker patina-image-worker patina-openimageio-worker RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/patina)
install(FILES resources/patina.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
# Pictures of models and projects in file managers, which give the output a name that ends with .png.
install(FILES resources/patina.thumbnailer DESTINATION ${CMAKE_INSTALL_DATADIR}/thumbnailers)
install(FILES resources/patina-mime.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages
  RENAME patina.xml)
install(FILES resources/patina.metainfo.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo
  RENAME org.patina.Patina.metainfo.xml)
install(FILES resources/icons/patina.svg
  DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
install(FILES resources/debian-copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/patina
  RENAME copyright)
# What scripts/package has made of the programs' own help.
install(DIRECTORY ${CMAKE_BINARY_DIR}/package/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL)
install(DIRECTORY ${CMAKE_BINARY_DIR}/package/completions/
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions OPTIONAL)

# Tests and tools are not installed: what is, is built before.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The Patina team <patina@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Desktop editor for physically based materials")
set(CPACK_PACKAGE_DESCRIPTION
  "Author physically based materials on models lit by HDR environments, look
at every term of the shading equation, bake ambient occlusion and
precomputed radiance transfer, export to glTF.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Loaded at run time: OpenGL with its drivers, and a font for the window.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libgl1, libegl1, libgl1-mesa-dri, fonts-dejavu-core")
include(CPack)
