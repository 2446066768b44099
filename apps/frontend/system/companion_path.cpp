#include "apps/frontend/system/companion_path.h"

#include <link.h>

#include <cstddef>
#include <sstream>
#include <system_error>
#include <vector>

#include "apps/frontend/system/trusted_path.h"

namespace dmpc::apps {

namespace fs = std::filesystem;

namespace {

/// Copies the run path from the dynamic section of the program itself, which is reported first.
int take_run_path(dl_phdr_info* info, std::size_t /*bytes*/, void* text) {
  for (std::size_t i = 0; i < info->dlpi_phnum; ++i) {
    const ElfW(Phdr)& header = info->dlpi_phdr[i];
    if (header.p_type != PT_DYNAMIC) {
      continue;
    }
    ElfW(Addr) names = 0, offset = 0;
    for (const auto* entry = reinterpret_cast<const ElfW(Dyn)*>(info->dlpi_addr + header.p_vaddr); entry->d_tag != DT_NULL;
         ++entry) {
      names = entry->d_tag == DT_STRTAB ? entry->d_un.d_ptr : names;
      offset = entry->d_tag == DT_RUNPATH || entry->d_tag == DT_RPATH ? entry->d_un.d_val : offset;
    }
    if (names != 0 && offset != 0) {
      names += names < info->dlpi_addr ? info->dlpi_addr : 0;  // not every loader has added the program's address
      *static_cast<std::string*>(text) = reinterpret_cast<const char*>(names + offset);
    }
  }
  return 1;
}

/// Returns the absolute folders of the run path with which the running program was linked.
std::vector<fs::path> run_path() {
  std::string text;
  ::dl_iterate_phdr(take_run_path, &text);
  std::vector<fs::path> folders;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ':');) {
    if (fs::path(word).is_absolute()) {
      folders.emplace_back(word);
    }
  }
  return folders;
}

std::vector<fs::path> places_of(const std::string& installed, CompanionOf whose) {
  std::error_code unknown;
  const fs::path folder = fs::read_symlink("/proc/self/exe", unknown).parent_path();
  if (folder.empty()) {  // without /proc the program's folder is unknown
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
    looked_at += " (which is ignored, since other users may have put it there: " + *why + ")";
  }
  throw InstallationError(what + " cannot be opened: it is in none of its places (" +
                          (looked_at.empty() ? "it has none: no run path, or no /proc" : looked_at) +
                          "): build or install dmpc as a whole");
}

}  // namespace dmpc::apps
