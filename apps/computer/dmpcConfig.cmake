# find_package(dmpc COMPONENTS computer): dmpc::computer, with which programs of one's own run on the emulated computer.
# COMPONENTS policy: dmpc::policy, the header of replacement policies for dmpc study references.
# COMPONENTS scenes: dmpc::scenes, with which they render, too; it needs the libraries of libhwy-dev and libtbb-dev.
include(CMakeFindDependencyMacro)
find_dependency(Threads)
include(${CMAKE_CURRENT_LIST_DIR}/dmpcTargets.cmake)
foreach(component IN LISTS dmpc_FIND_COMPONENTS)
  set(dmpc_${component}_FOUND ON)
  if(NOT TARGET dmpc::${component})
    set(dmpc_${component}_FOUND OFF)
    if(dmpc_FIND_REQUIRED_${component})
      set(dmpc_FOUND OFF)
      set(dmpc_NOT_FOUND_MESSAGE "dmpc has no component ${component}; there are computer, policy and scenes")
    endif()
  endif()
endforeach()
