// dmpc, or another program, as mpirun starts it, on one computer.
#pragma once

#include <string>
#include <vector>

#include "tests/support/shell.h"

namespace dmpc::tests {

/// How frames travel: Open MPI's names.
inline const std::string shared_memory = "vader,self", tcp = "tcp,self";

/// `ranks` times a program with these arguments. Root may do so, and more than there are processors, none bound to one of them.
/// Nobody looks for graphics cards behind the screens :0 to :9, by the name of this computer's loop, which takes seconds where no
/// name resolves.
inline std::vector<std::string> mpirun_of(int ranks, const std::string& program, const std::vector<std::string>& arguments,
                                          const std::string& way = shared_memory) {
  std::vector<std::string> command = {"/usr/bin/env",
                                      "OMPI_ALLOW_RUN_AS_ROOT=1",
                                      "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1",
                                      "OMPI_MCA_rmaps_base_oversubscribe=1",
                                      "OMPI_MCA_hwloc_base_binding_policy=none",
                                      "HWLOC_COMPONENTS=-gl,-opencl",
                                      "OMPI_MCA_btl=" + way,
                                      "mpirun",
                                      "-n",
                                      std::to_string(ranks),
                                      program};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}
/// The words that start dmpc so.
inline std::vector<std::string> mpirun(int ranks, const std::vector<std::string>& arguments,
                                       const std::string& way = shared_memory) {
  return mpirun_of(ranks, DMPC_PROGRAM, arguments, way);
}

}  // namespace dmpc::tests
