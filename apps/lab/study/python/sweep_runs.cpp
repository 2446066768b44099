#include <algorithm>
#include <cctype>
#include <iterator>
#include <set>
#include <string_view>

#include "apps/build/command.h"
#include "apps/frontend/line/command_line.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/unknown_option.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/system/digest.h"
#include "apps/lab/study/python/sweep.h"
#include "apps/scene/database_facts.h"
#include "core/base/expect.h"
#include "core/base/nearest_word.h"
#include "core/base/ranges.h"

namespace dmpc::apps {
namespace {

constexpr std::size_t runs_max = 10'000;

/// Options of outputs, of continuing earlier ones, and of messages.
constexpr const char* unsweepable[] = {
    "--help",         "--output",    "--stats",       "--report",     "--heatmap",    "--aov",    "--trace",
    "--trace-window", "--serve",     "--quiet",       "--references", "--checkpoint", "--resume", "--checkpoint-every",
    "--frames",       "--turntable", "--camera-path", "--animation",  "--fps"};

/// Parses one line of `render` alone.
class RenderLine {
 public:
  RenderLine() {
    line_.stand_for_options(standing_of_scene());
    add_options(line_.add_command("render", ""), options_);
  }
  // Options are bound to the member.
  RenderLine(const RenderLine&) = delete;
  RenderLine& operator=(const RenderLine&) = delete;

  CommandDescription describe() const { return line_.describe().commands.front(); }
  /// Throws core::UsageError.
  RenderOptions parse(const std::vector<std::string>& words) {
    line_.parse(words);
    return options_;
  }

 private:
  CommandLine line_{"", "", ""};
  RenderOptions options_;
};

bool is_sweepable(const OptionDescription& option) {
  return std::find(std::begin(unsweepable), std::end(unsweepable), option.names.back()) == std::end(unsweepable);
}

const OptionDescription& find_option(const std::string& name, const std::string& text) {
  std::vector<std::string> names;
  for (const OptionDescription& option : sweepable_options()) {
    if (option.names.back() == "--" + name) {
      return option;
    }
    names.push_back(option.names.back().substr(2));
  }
  if (const std::string instead = said_instead_of("--" + name); !instead.empty()) {
    throw core::UsageError("--vary=" + text + ": " + name + " is no option of dmpc render any more: " + instead);
  }
  throw core::UsageError("--vary=" + text + ": " + (name.empty() ? "an option's name is missing" : name) +
                         (name.empty() ? "" : " is no option of dmpc render that says how it renders") +
                         "; expected one with its values, such as page-size:1KiB,4KiB." + core::did_you_mean(name, names));
}

void check_values(const VariedOption& variation, const std::string& text) {
  std::set<std::string> seen;
  for (const std::string& value : variation.values) {
    if (value.empty()) {
      throw core::UsageError("--vary=" + text + ": a value is missing; expected values with commas between, or semicolons");
    }
    if (variation.is_flag && value != "on" && value != "off") {
      throw core::UsageError("--vary=" + text + ": " + variation.option + " is a flag; expected on, off or on,off");
    }
    if (!seen.insert(value).second) {
      throw core::UsageError("--vary=" + text + ": " + value + " is there twice");
    }
  }
}

/// A value that contains commas, such as a camera's position, ends with a semicolon.
std::vector<std::string> values_in(const std::string& text) {
  const std::string whole = text.substr(0, text.size() - (text.ends_with(';') ? 1 : 0));
  return words_between(whole, text.find(';') == std::string::npos ? ',' : ';');
}

/// Returns `runs` with every value of `variation` appended to each.
std::vector<SweepRun> varied(const std::vector<SweepRun>& runs, const VariedOption& variation) {
  std::vector<SweepRun> all;
  for (const SweepRun& run : runs) {
    for (const std::string& value : variation.values) {
      SweepRun& next = all.emplace_back(run);
      const std::string word = variation.option + (variation.is_flag ? "" : "=" + value);
      next.varied += (run.varied.empty() ? "" : " ") + word + (variation.is_flag ? " " + value : "");
      if (!variation.is_flag || value == "on") {
        next.words.push_back(word);
      }
    }
  }
  return all;
}

void check_count(const SweepStudy& study) {
  std::size_t count = 1;
  for (const VariedOption& variation : study.variations) {
    count *= variation.values.size();
    if (count > runs_max) {
      throw core::UsageError("these are more than " + grouped(runs_max) + " runs: vary fewer options, or give fewer values");
    }
  }
}

/// Returns whether any of these options is given.
bool gives_any(const std::vector<std::string>& words, const std::set<std::string>& names) {
  return std::ranges::any_of(words, [&](const std::string& word) { return names.contains(word.substr(0, word.find('='))); });
}

void check_options(const SweepStudy& study) {
  std::set<std::string> varied;
  for (const VariedOption& variation : study.variations) {
    if (gives_any(study.fixed, {variation.option})) {
      throw core::UsageError(variation.option + " is given, and varied, too: expected one of them");
    }
    if (!varied.insert(variation.option).second) {
      throw core::UsageError("--vary=" + variation.option.substr(2) + " is given twice: give all its values at once");
    }
  }
}

/// A sweep measures the cost of a picture, so a mesh file is shown as other scenes are, unless an option says otherwise.
void add_words_of_mesh(std::vector<std::string>& words) {
  if (!gives_any(words, {"--transport"})) {
    words.emplace_back("--transport=whitted");
    if (!gives_any(words, {"--samples", "--quality", "--error"})) {
      words.emplace_back("--samples=1");
    }
  }
}

/// Returns the options of `render` for a combination.
RenderOptions options_of(const SweepRun& run) {
  try {
    std::vector<std::string> words = run.words;
    words.insert(words.end(), {"--quiet", "--stats=stats.json", "--output=picture.png"});
    return RenderLine().parse(words);
  } catch (const core::UsageError& error) {
    throw core::UsageError("with " + run.varied + " dmpc render would say: " + error.what());
  }
}

/// Returns what of a scene's name a file's can have.
std::string file_name_of(const std::string& scene) {
  std::string name = std::filesystem::path(scene).filename().string().substr(0, 40);
  std::replace_if(
      name.begin(), name.end(), [](unsigned char letter) { return std::isalnum(letter) == 0 && letter != '-'; }, '_');
  return name;
}

/// Returns a digest of all that decides the database of a scene.
std::uint64_t digest_of_database(const RenderOptions& options) {
  Digest digest;
  digest.add(std::string_view(options.picture.scene));
  for (const auto& [name, value] : database_facts(options.picture, options.database.build)) {
    digest.add(std::string_view(value));
  }
  digest.add(static_cast<std::uint64_t>(options.database.instances) << 1U | (options.picture.is_refined ? 1U : 0U));
  digest.add(std::string_view(options.database.why_copied));
  if (options.picture.scene_setup.camera) {  // the database is that of its distance
    digest.add(std::string_view(text_of(*options.picture.scene_setup.camera)));
  }
  return digest.value();
}

/// Returns the words of a run that `build` takes, too, with what the run's strategy decides.
std::vector<std::string> build_words(const SweepRun& run) {
  static const std::set<std::string> names = [] {
    BuildRequest none;
    CommandLine line{"", "", ""};
    add_options(line.add_command("build", ""), none);
    const CommandDescription build = line.describe().commands.front();
    const std::vector<std::string> all =
        core::mapped<std::string>(build.options, [](const OptionDescription& option) { return option.names.back(); });
    return std::set<std::string>(all.begin(), all.end());
  }();
  const DatabaseOptions& database = run.options.database;
  std::vector<std::string> words = words_of(database.build);
  if (database.instances == InstancesChoice::automatic && database.why_copied.empty()) {  // the scene decides
    std::erase_if(words, [](const std::string& word) { return word == "--structure=grid" || word.starts_with("--instances="); });
    words.emplace_back("--instances=auto");
  }
  std::copy_if(run.words.begin(), run.words.end(), std::back_inserter(words),
               [](const std::string& word) { return names.contains(word.substr(0, word.find('='))) && !is_of_building(word); });
  return words;
}

}  // namespace

const std::vector<OptionDescription>& sweepable_options() {
  static const std::vector<OptionDescription> options = [] {
    std::vector<OptionDescription> all = RenderLine().describe().options;
    std::erase_if(all, [](const OptionDescription& option) { return !is_sweepable(option); });
    return all;
  }();
  return options;
}

VariedOption parse_variation(const std::string& text) {
  const std::size_t colon = text.find(':');
  std::string name = text.substr(0, colon);
  name.erase(0, name.starts_with("--") ? 2 : 0);
  const OptionDescription& option = find_option(name, text);
  if (colon == std::string::npos) {
    throw core::UsageError("--vary=" + text + ": the values are missing; expected " + name + ":VALUE,VALUE,...");
  }
  VariedOption variation{"--" + name, option.value.empty(), values_in(text.substr(colon + 1))};
  check_values(variation, text);
  return variation;
}

std::vector<SweepRun> sweep_runs(const SweepStudy& study) {
  check_count(study);
  check_options(study);
  std::vector<SweepRun> runs = {{.varied = {}, .words = {"render", study.scene}, .options = {}}};
  runs.front().words.insert(runs.front().words.end(), study.fixed.begin(), study.fixed.end());
  for (const VariedOption& variation : study.variations) {
    runs = varied(runs, variation);
  }
  for (SweepRun& run : runs) {
    if (is_mesh(study.scene)) {
      add_words_of_mesh(run.words);
    }
    run.options = options_of(run);
  }
  return runs;
}

SweepDatabase database_of(const SweepRun& run, std::uint64_t source) {
  const RenderOptions& options = run.options;
  if (options.picture.stored || options.frames.animation) {
    return {"-", {}};
  }
  const std::string name = file_name_of(options.picture.scene) + "-" + hash_text(digest_of_database(options)) + "-";
  return {name + hash_text(source) + ".pages", build_words(run)};
}

}  // namespace dmpc::apps
