# The Debian packages: cpack -G DEB in the build's folder writes dmpc_VERSION_ARCHITECTURE.deb,
# libdmpc-dev_VERSION_ARCHITECTURE.deb, python3-dmpc_VERSION_all.deb and, where there is MPI, dmpc-mpi_VERSION_ARCHITECTURE.deb.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME dmpc)
set(CPACK_PACKAGE_VENDOR "the dmpc developers")
set(CPACK_PACKAGE_CONTACT "the dmpc developers <dmpc@localhost>" CACHE STRING "Who maintains the packages")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "distributed-memory parallel computer on one machine, for ray tracing")
set(CPACK_PACKAGE_DESCRIPTION "Emulates N nodes, each with a strictly bounded memory of its own, that
talk only through mailboxes, and renders on them scenes that fit into none
of them. Either pages of the scene travel to the rays or rays travel to the
scene; all traffic is counted.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program python development)
if(TARGET dmpc_module_mpi)
  list(APPEND CPACK_COMPONENTS_ALL mpi)
endif()
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME dmpc)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION ${CPACK_PACKAGE_DESCRIPTION})
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "dmpc-mpi, python3-dmpc")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-dmpc)
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
  "dmpc (= ${PROJECT_VERSION}), python3, python3-numpy, python3-pandas, python3-openimageio")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS python3-matplotlib)
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "dmpc from Python: renders and studies as frames and arrays
A pure module that runs the program dmpc and hands back its counters, the
figures of its nodes, its film and heat maps, and tables of many runs; a
notebook shows them.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libdmpc-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "g++ (>= 4:12)")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS "libhwy-dev, libtbb-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS
  "cmake (>= 3.25), dmpc (= ${PROJECT_VERSION}), dmpc-mpi (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "dmpc's computer for programs of one's own
Headers, libraries and examples: programs for nodes with bounded memories
that talk only through mailboxes, run on threads, of one process or several,
or on the model of a machine in virtual time.")
set(CPACK_DEBIAN_MPI_PACKAGE_NAME dmpc-mpi)
set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS "dmpc (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_MPI_PACKAGE_RECOMMENDS openmpi-bin)
set(CPACK_DEBIAN_MPI_DESCRIPTION "several processes for dmpc, by MPI
The module with which dmpc runs on several processes, on one computer or on
many, that mpirun or srun has started.")
# What each package says of its authors, licences and versions, as Debian's policy asks (12.5, 12.7).
set(papers ${CMAKE_CURRENT_BINARY_DIR}/papers)
file(MAKE_DIRECTORY ${papers})
execute_process(COMMAND gzip -9nc ${CMAKE_CURRENT_LIST_DIR}/changelog OUTPUT_FILE ${papers}/changelog.gz COMMAND_ERROR_IS_FATAL ANY)
foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} name)
  set(package ${CPACK_DEBIAN_${name}_PACKAGE_NAME})
  configure_file(${CMAKE_CURRENT_LIST_DIR}/lintian-overrides.in ${papers}/${package} @ONLY)
  install(FILES ${CMAKE_CURRENT_LIST_DIR}/copyright ${papers}/changelog.gz COMPONENT ${component}
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package})
  install(FILES ${papers}/${package} COMPONENT ${component} DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides)
endforeach()
# Debian has the text of this licence.
install(CODE "
  if(NOT CMAKE_INSTALL_PREFIX STREQUAL \"/usr\")
    file(INSTALL DESTINATION \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/doc/dmpc\" FILES \"${PROJECT_SOURCE_DIR}/LICENSE\")
  endif()")
include(CPack)
