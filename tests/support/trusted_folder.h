// A folder for one test where what dmpc loads may lie, as a temporary one may not: everybody may write beside that.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

#include "core/base/expect.h"

namespace dmpc::tests {

/// Beside the programs of the build, whose folders dmpc trusts; gone with everything in it afterwards.
class TrustedFolder {
 public:
  explicit TrustedFolder(const std::filesystem::path& build) {
    std::string name = (std::filesystem::canonical(build) / "tests/trusted-XXXXXX").string();
    core::expect(::mkdtemp(name.data()) != nullptr, "a folder can be made where programs are built");
    path_ = name;
  }
  ~TrustedFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  TrustedFolder(const TrustedFolder&) = delete;
  TrustedFolder& operator=(const TrustedFolder&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace dmpc::tests
