#include "apps/lab/study/sweep/settings.h"

#include <algorithm>
#include <set>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/unknown_option.h"
#include "apps/frontend/line/words.h"
#include "apps/lab/study/engine/render_process.h"
#include "apps/scene/database_facts.h"
#include "apps/scene/load_scene.h"
#include "core/base/expect.h"
#include "core/base/nearest_word.h"

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
  return std::find(std::begin(unsweepable), std::end(unsweepable), long_name_of(option)) == std::end(unsweepable);
}

const OptionDescription& find_option(const std::string& name, const std::string& text) {
  std::vector<std::string> names;
  for (const OptionDescription& option : sweepable_options()) {
    if (long_name_of(option) == "--" + name) {
      return option;
    }
    names.push_back(long_name_of(option).substr(2));
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
  if (text.find(';') == std::string::npos) {
    return words_between(text, ',');
  }
  std::vector<std::string> values = words_between(text, ';');
  if (values.back().empty()) {
    values.pop_back();
  }
  return values;
}

/// Returns the word that sets an option to a value; nothing for a flag that is off.
std::optional<std::string> word_of(const VariedOption& variation, const std::string& value) {
  if (variation.is_flag) {
    return value == "on" ? std::optional(variation.option) : std::nullopt;
  }
  return variation.option + "=" + value;
}

/// Returns `runs` with every value of `variation` appended to each.
std::vector<SweepRun> varied(const std::vector<SweepRun>& runs, const VariedOption& variation) {
  std::vector<SweepRun> all;
  for (const SweepRun& run : runs) {
    for (const std::string& value : variation.values) {
      SweepRun& next = all.emplace_back(run);
      next.values.push_back(value);
      if (const std::optional<std::string> word = word_of(variation, value)) {
        next.words.push_back(*word);
      }
    }
  }
  return all;
}

void check_count(const SweepSettings& settings) {
  std::size_t count = 1;
  for (const VariedOption& variation : settings.variations) {
    count *= variation.values.size();
    if (count > runs_max) {
      throw core::UsageError("these are more than " + grouped(runs_max) + " runs: vary fewer options, or give fewer values");
    }
  }
}

void check_options(const SweepSettings& settings) {
  std::set<std::string> varied;
  for (const VariedOption& variation : settings.variations) {
    const auto is_it = [&](const std::string& word) { return word.substr(0, word.find('=')) == variation.option; };
    if (std::any_of(settings.fixed.begin(), settings.fixed.end(), is_it)) {
      throw core::UsageError(variation.option + " is given, and varied, too: expected one of them");
    }
    if (!varied.insert(variation.option).second) {
      throw core::UsageError("--vary=" + variation.option.substr(2) + " is given twice: give all its values at once");
    }
  }
}

/// Returns the options of `render` for a combination.
RenderOptions options_of(const SweepRun& run, const std::vector<VariedOption>& variations) {
  try {
    return RenderLine().parse(RenderProcesses::with_outputs(run.words, "stats.json", "picture.exr"));
  } catch (const core::UsageError& error) {
    throw core::UsageError("with " + text_of(variations, run) + " dmpc render would say: " + error.what());
  }
}

/// Returns whether any of these options of `render` is fixed or varied.
bool gives_any(const SweepSettings& settings, const std::set<std::string>& names) {
  const auto is_one = [&](const std::string& word) { return names.contains(word.substr(0, word.find('='))); };
  return std::any_of(settings.fixed.begin(), settings.fixed.end(), is_one) ||
         std::any_of(settings.variations.begin(), settings.variations.end(),
                     [&](const VariedOption& variation) { return is_one(variation.option); });
}

}  // namespace

std::string long_name_of(const OptionDescription& option) { return option.names.back(); }

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

std::vector<SweepRun> sweep_runs(const SweepSettings& settings) {
  check_count(settings);
  check_options(settings);
  std::vector<std::string> words = {"render", settings.scene};
  words.insert(words.end(), settings.fixed.begin(), settings.fixed.end());
  // A sweep measures the cost of a picture, so a mesh file is shown as other scenes are, unless an option says otherwise.
  if (is_mesh(settings.scene) && !gives_any(settings, {"--transport"})) {
    words.emplace_back("--transport=whitted");
    if (!gives_any(settings, {"--samples", "--quality", "--error"})) {
      words.emplace_back("--samples=1");
    }
  }
  std::vector<SweepRun> runs = {{.values = {}, .words = words, .options = {}}};
  for (const VariedOption& variation : settings.variations) {
    runs = varied(runs, variation);
  }
  for (SweepRun& run : runs) {
    run.options = options_of(run, settings.variations);
  }
  return runs;
}

OpenedFiles scene_files(const SweepSettings& settings, const SweepRun& run) {
  OpenedFiles opened;
  std::vector<NamedFile> named;
  add_scene_file(settings.scene, named);
  if (!named.empty()) {
    load_scene(run.options.picture, LoadNotes::silent, &opened);
  }
  return opened;
}

std::string text_of(const std::vector<VariedOption>& variations, const SweepRun& run) {
  std::string text;
  for (std::size_t i = 0; i < variations.size(); ++i) {
    const std::string word =
        variations[i].is_flag ? variations[i].option + " " + run.values[i] : variations[i].option + "=" + run.values[i];
    text += (text.empty() ? "" : " ") + word;
  }
  return text;
}

}  // namespace dmpc::apps
