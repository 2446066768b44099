#include "apps/frontend/system/output_set.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "apps/frontend/system/resource_exhaustion.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"

namespace dmpc::apps {

namespace {

/// An output, its folder, and a picture in memory; for a drawing program, a scratch file and the ends of a pipe; two to spare.
constexpr std::size_t open_files_needed = 8;

}  // namespace

std::vector<NamedFile> files_of(const std::vector<OutputName>& outputs) {
  return core::mapped<NamedFile>(outputs, &OutputName::file);
}

void check_outputs(const std::vector<NamedFile>& inputs, const std::vector<OutputName>& outputs) {
  check_distinct(inputs, files_of(outputs));
  for (const OutputName& output : outputs) {
    output.check(output.file.path, output.file.name);
  }
}

void check_standard_output(const std::string& what, const std::string& advice) {
  const bool is_taken = ::write(STDOUT_FILENO, "", 0) == 0;
  if (!is_taken) {
    throw core::InputError(what + " could not be written to the standard output: " + std::strerror(errno) + "; " + advice);
  }
}

void check_open_files() {
  std::array<int, open_files_needed> files{};
  for (int& file : files) {
    file = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  }
  const bool are_open = files.back() >= 0;
  for (const int file : files) {
    ::close(file);
  }
  if (!are_open) {
    throw ComputerCapacityError("no " + std::to_string(open_files_needed) +
                                " files more can be open at a time, which outputs take: raise the limit (ulimit -n)");
  }
}

}  // namespace dmpc::apps
