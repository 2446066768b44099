#include "apps/frontend/system/distinct_files.h"

#include <system_error>

#include "apps/frontend/system/output_file.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace fs = std::filesystem;

namespace {

/// Returns where `path` leads, even if no file exists there yet.
fs::path resolve(const fs::path& path) {
  std::error_code error;
  const fs::path resolved = fs::weakly_canonical(fs::absolute(file_behind(path), error), error);
  return error ? path : resolved;
}

bool same_file(const fs::path& a, const fs::path& b) {
  if (is_special(a) || is_special(b)) {
    return false;
  }
  std::error_code error;
  return fs::equivalent(a, b, error) || resolve(a) == resolve(b);
}

void expect_apart(const NamedFile& output, const NamedFile& other) {
  if (same_file(output.path, other.path)) {
    throw core::UsageError(output.name + " " + output.path.string() + ": this is the same file as " + other.name + " " +
                           other.path.string() + ", give another name");
  }
}

}  // namespace

void check_distinct(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs) {
  for (auto output = outputs.begin(); output != outputs.end(); ++output) {
    for (const NamedFile& input : inputs) {
      expect_apart(*output, input);
    }
    for (auto earlier = outputs.begin(); earlier != output; ++earlier) {
      expect_apart(*output, *earlier);
    }
  }
}

void check_not_read(const OpenedFiles& inputs, const std::vector<NamedFile>& outputs) {
  for (const NamedFile& output : outputs) {
    for (const fs::path& input : inputs.paths()) {
      expect_apart(output, {"the scene's", input});
    }
  }
}

}  // namespace dmpc::apps
