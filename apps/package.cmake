# The Debian package: cpack -G DEB in the build's folder writes dmpc_VERSION_ARCHITECTURE.deb.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME dmpc)
set(CPACK_PACKAGE_VENDOR "the dmpc developers")
set(CPACK_PACKAGE_CONTACT "the dmpc developers <dmpc@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "distributed-memory parallel computer on one machine, for ray tracing")
set(CPACK_PACKAGE_DESCRIPTION "Emulates N nodes, each with a strictly bounded memory of its own, that talk only through
mailboxes, and renders on them scenes that fit into none of them. Either pages of the
scene travel to the rays or rays travel to the scene; all traffic is counted.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS gnuplot-nox)
include(CPack)
