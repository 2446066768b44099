#include "apps/lab/study/sweep/kept_runs.h"

#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "apps/edge/line/number_text.h"
#include "apps/edge/system/digest.h"
#include "apps/edge/system/output_file.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

namespace fs = std::filesystem;

void add_file(const fs::path& path, Digest& digest) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  digest.add(std::string_view(text.str()));
}

/// Adds a word such as "--machine=mine.json", and the file that it names.
void add_word(const std::string& word, Digest& digest) {
  digest.add(std::string_view(word));
  const std::size_t sign = word.find('=');
  std::error_code none;
  if (sign != std::string::npos && fs::is_regular_file(word.substr(sign + 1), none)) {
    add_file(word.substr(sign + 1), digest);
  }
}

}  // namespace

KeptRuns::KeptRuns(const fs::path& folder, const fs::path& program, const OpenedFiles& scene) : folder_(folder) {
  make_output_folder(folder, "--runs");
  Digest digest;
  add_file(program, digest);
  for (const fs::path& path : scene.paths()) {
    add_file(path, digest);
  }
  common_ = digest.value();
}

fs::path KeptRuns::file_of(const SweepRun& run) const {
  const std::multiset<std::string> words(run.words.begin(), run.words.end());
  Digest digest;
  digest.add(common_);
  for (const std::string& word : words) {
    add_word(word, digest);
  }
  return folder_ / (hash_text(digest.value()) + ".json");
}

std::optional<std::vector<Figure>> KeptRuns::find(const SweepRun& run) const {
  const fs::path file = file_of(run);
  std::error_code none;
  if (!fs::exists(file, none)) {
    return std::nullopt;
  }
  try {
    return read_figures(file);
  } catch (const core::InputError&) {
    return std::nullopt;
  }
}

}  // namespace dmpc::apps
