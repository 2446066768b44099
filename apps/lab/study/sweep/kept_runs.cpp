#include "apps/lab/study/sweep/kept_runs.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <mutex>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>
#include <variant>

#include "apps/edge/line/number_text.h"
#include "apps/edge/system/companion_path.h"
#include "apps/edge/system/descriptor.h"
#include "apps/edge/system/digest.h"
#include "apps/edge/system/interrupt.h"
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

/// What reads for the program and what it opens: another of them may make another picture of the same scene. What is not
/// installed takes no part.
void add_companions(Digest& digest) {
  for (const auto& [name, folder] : {std::pair("dmpc_mesh_reader", "../libexec/dmpc"),
                                     {"dmpc_picture_reader", "../libexec/dmpc"},
                                     {"dmpc_embree.so", "../lib/dmpc"}}) {
    try {
      add_file(companion_path(name, folder, name), digest);
    } catch (const InstallationError&) {
      digest.add(std::string_view("none"));
    }
  }
}

/// The text of an ordinary file, and of nothing that a link leads to; nothing of one that is too long for counters.
std::optional<std::string> entry_text(const fs::path& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  struct stat status {};
  if (!file.is_open() || ::fstat(file.number(), &status) != 0 || !S_ISREG(status.st_mode) ||
      static_cast<std::uint64_t>(status.st_size) > figures_bytes_max) {
    return std::nullopt;
  }
  std::string text(static_cast<std::size_t>(status.st_size), '\0');
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t count = ::read(file.number(), text.data() + done, text.size() - done);
    if (count <= 0 && !(count < 0 && errno == EINTR)) {
      return std::nullopt;
    }
    done += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
  }
  return text;
}

bool takes_all(const Descriptor& file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(file.number(), text.data(), text.size());
    if (count < 0 && errno != EINTR) {
      return false;
    }
    text.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  }
  return ::fsync(file.number()) == 0;
}

/// Whether a figure is there, or said to be none: "pages" is null where no pages travel.
/// What each strategy calls by names of its own is there if others of its kind are.
bool has(const std::vector<Figure>& figures, const std::string& column) {
  const std::size_t kinds = std::min(column.find(".by_kind."), column.find(".waiting."));
  const std::string kin = kinds == std::string::npos ? column : column.substr(0, column.find('.', kinds + 1) + 1);
  return std::any_of(figures.begin(), figures.end(), [&](const Figure& figure) {
    const bool is_above = column.starts_with(figure.name + ".") && std::holds_alternative<std::monostate>(figure.value);
    return figure.name == column || is_above || (kinds != std::string::npos && figure.name.starts_with(kin));
  });
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
  const fs::path file = file_of(run);
  const std::optional<std::string> text = entry_text(file);
  if (!text) {
    return std::nullopt;
  }
  try {
    std::vector<Figure> figures = parse_figures(*text, file.string());
    const bool is_whole =
        std::all_of(columns_.begin(), columns_.end(), [&](const std::string& column) { return has(figures, column); });
    return is_whole ? std::optional(std::move(figures)) : std::nullopt;
  } catch (const core::InputError&) {
    return std::nullopt;
  }
}

/// Under a name of its own first, which then replaces whatever is there, a link itself and not what it leads to.
void KeptRuns::keep(const SweepRun& run, const fs::path& stats) const {
  static std::mutex one_at_a_time;  // there are few places for files under way
  const std::lock_guard lock(one_at_a_time);
  std::ostringstream text;
  text << std::ifstream(stats, std::ios::binary).rdbuf();
  const std::string name = hidden_name(file_of(run), std::to_string(::getpid())).string();
  ::unlink(name.c_str());
  const Descriptor file(::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666));
  const RemovedAtOnce removed_at_once(name);
  if (!file.is_open() || !takes_all(file, text.view()) || ::rename(name.c_str(), file_of(run).c_str()) != 0) {
    const int error = errno;
    ::unlink(name.c_str());
    throw core::InputError("--runs " + folder_.string() + ": counters cannot be kept there: " + std::strerror(error));
  }
}

}  // namespace dmpc::apps
