#include "apps/edge/system/companion_path.h"

#include <dlfcn.h>
#include <link.h>
#include <unistd.h>

#include <cstddef>
#include <system_error>
#include <vector>

#include "apps/edge/system/trusted_path.h"

namespace dmpc::apps {

namespace fs = std::filesystem;

namespace {

/// The run path that the running program was linked with, as far as it is absolute.
std::vector<fs::path> run_path() {
  std::vector<fs::path> folders;
  void* const program = ::dlopen(nullptr, RTLD_NOW);
  Dl_serinfo size{};
  if (program != nullptr && ::dlinfo(program, RTLD_DI_SERINFOSIZE, &size) == 0) {
    std::vector<std::max_align_t> memory(size.dls_size / sizeof(std::max_align_t) + 1);
    auto* const all = reinterpret_cast<Dl_serinfo*>(memory.data());
    *all = size;
    const bool is_known = ::dlinfo(program, RTLD_DI_SERINFO, all) == 0;
    const Dl_serpath* const first = all->dls_serpath;
    for (unsigned i = 0; is_known && i < all->dls_cnt; ++i) {
      if ((first[i].dls_flags & LA_SER_RUNPATH) != 0 && fs::path(first[i].dls_name).is_absolute()) {
        folders.emplace_back(first[i].dls_name);
      }
    }
  }
  return folders;
}

std::vector<fs::path> places_of(const std::string& installed, CompanionOf whose) {
  std::error_code unknown;
  const fs::path folder = fs::read_symlink("/proc/self/exe", unknown).parent_path();
  if (folder.empty()) {  // without /proc nothing is known of where we are
    return {};
  }
  std::vector<fs::path> places = whose == CompanionOf::dmpc ? std::vector{folder, folder / installed} : run_path();
  if (folder.filename() == "tests") {
    places.push_back(folder / "../apps");
  }
  return places;
}

}  // namespace

fs::path companion_path(const std::string& name, const std::string& installed, const std::string& what, CompanionOf whose) {
  std::string looked_at;
  for (const fs::path& place : places_of(installed, whose)) {
    std::error_code missing;
    const fs::path file = (place / name).lexically_normal(), found = fs::canonical(file, missing);
    looked_at += (looked_at.empty() ? "" : ", ") + file.string();
    if (missing) {
      continue;
    }
    const auto why = why_untrusted(found);
    if (!why) {
      return found;
    }
    looked_at += " (which is passed over, since others than you may have put it there: " + *why + ")";
  }
  throw InstallationError(what + " cannot be opened: it is in none of its places (" +
                          (looked_at.empty() ? "it has none: no run path, or no /proc" : looked_at) +
                          "): build or install dmpc as a whole");
}

}  // namespace dmpc::apps
