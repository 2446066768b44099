#include "apps/lab/study/sweep/kept_runs.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <mutex>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>
#include <variant>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/system/companion_path.h"
#include "apps/frontend/system/descriptor.h"
#include "apps/frontend/system/digest.h"
#include "apps/frontend/system/output_file.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

namespace fs = std::filesystem;

void add_file(const fs::path& path, Digest& digest) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  digest.add(std::string_view(text.str()));
}

/// Adds the readers and modules of the program: another version may render another picture of the same scene. Missing ones are
/// skipped.
void add_companions(Digest& digest) {
  for (const auto& [name, folder] : {std::pair("dmpc_mesh_reader", "../libexec/dmpc"),
                                     {"dmpc_picture_reader", "../libexec/dmpc"},
                                     {"dmpc_plain_picture_reader", "../libexec/dmpc"},
                                     {"dmpc_embree.so", "../lib/dmpc"}}) {
    try {
      add_file(companion_path(name, folder, name), digest);
    } catch (const InstallationError&) {
      digest.add(std::string_view("none"));
    }
  }
}

/// Reads an ordinary file without following links. Throws core::InputError.
std::vector<Figure> read_entry(const fs::path& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  struct stat status {};
  if (!file.is_open() || ::fstat(file.number(), &status) != 0 || !S_ISREG(status.st_mode)) {
    throw core::InputError(path.string() + ": expected a file of counters");
  }
  return read_figures("/proc/self/fd/" + std::to_string(file.number()));
}

/// Returns whether a figure is present, or reported as absent: "pages" is null if no pages travel. A figure that strategies name
/// differently is present if others of its kind are.
bool has(const std::vector<Figure>& figures, const std::string& column) {
  const std::size_t kinds = std::min(column.find(".by_kind."), column.find(".waiting."));
  const std::string kin = kinds == std::string::npos ? column : column.substr(0, column.find('.', kinds + 1) + 1);
  return std::any_of(figures.begin(), figures.end(), [&](const Figure& figure) {
    const bool is_above = column.starts_with(figure.name + ".") && std::holds_alternative<std::monostate>(figure.value);
    return figure.name == column || is_above || (kinds != std::string::npos && figure.name.starts_with(kin));
  });
}

/// Adds a word such as "--machine=mine.json" or "--replacement=python:/mine.py:Mine", and the file that it names.
void add_word(const std::string& word, Digest& digest) {
  digest.add(std::string_view(word));
  constexpr std::string_view python = "--replacement=python:";
  const bool is_python = word.starts_with(python);
  const std::size_t begin = is_python ? python.size() : word.find('=') + 1, end = is_python ? word.rfind(':') : word.size();
  const std::string value = word.substr(begin, std::max(begin, end) - begin);
  std::error_code none;
  if (begin > 0 && fs::is_regular_file(value, none)) {
    add_file(value, digest);
  }
}

}  // namespace

KeptRuns::KeptRuns(const fs::path& folder, const fs::path& program, const OpenedFiles& scene, std::vector<std::string> columns)
    : folder_(folder), columns_(std::move(columns)) {
  make_output_folder(folder, "--runs");
  Digest digest;
  add_file(program, digest);
  add_companions(digest);
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
  try {
    std::vector<Figure> figures = read_entry(file_of(run));
    const bool is_whole =
        std::all_of(columns_.begin(), columns_.end(), [&](const std::string& column) { return has(figures, column); });
    return is_whole ? std::optional(std::move(figures)) : std::nullopt;
  } catch (const core::InputError&) {
    return std::nullopt;
  }
}

void KeptRuns::keep(const SweepRun& run, const fs::path& stats) const {
  static std::mutex one_at_a_time;  // the slots for files in progress are few
  const std::lock_guard lock(one_at_a_time);
  OutputFile file(file_of(run), {.replaces = Replaces::name, .option = "--runs"});
  file.stream() << std::ifstream(stats, std::ios::binary).rdbuf();
  file.commit();
}

}  // namespace dmpc::apps
