#include "apps/lab/figures/known_figures.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/frontend/line/words.h"
#include "apps/show/stats/schema.h"
#include "core/base/expect.h"
#include "core/base/nearest_word.h"
#include "core/base/ranges.h"

namespace dmpc::apps {

namespace {

using Json = nlohmann::ordered_json;

/// Collects names below one location of the schema.
class SchemaWalk {
 public:
  explicit SchemaWalk(const Json& schema) : schema_(schema) {}

  void add(const Json& place, const std::string& name) {
    const Json& meant = resolved(place);
    if (meant.contains("properties")) {
      for (const auto& [key, value] : meant["properties"].items()) {
        add(value, name.empty() ? key : name + "." + key);
      }
    } else if (meant.contains("propertyNames")) {
      for (const Json& key : resolved(meant["propertyNames"])["enum"]) {
        add(meant["additionalProperties"], name + "." + key.get<std::string>());
      }
    } else if (meant.contains("prefixItems")) {
      figures_.push_back({name + ".*", false});
    } else if (meant.contains("items")) {
      add(meant["items"], name + ".*");
    } else {
      figures_.push_back({name, has_number(meant)});
    }
  }
  std::vector<KnownFigure> figures() { return std::move(figures_); }

 private:
  /// Returns the target of a reference, or the first of several alternatives, of which the others are null.
  const Json& resolved(const Json& place) const {
    if (place.contains("anyOf")) {
      return resolved(place["anyOf"][0]);
    }
    if (place.contains("$ref")) {
      return resolved(schema_.at(Json::json_pointer(place["$ref"].get<std::string>().substr(1))));
    }
    return place;
  }

  /// "type" is one type, or several of which one is null.
  static bool has_number(const Json& place) {
    const Json type = place.value("type", Json());
    const Json first = type.is_array() ? type[0] : type;
    return first == "integer" || first == "number";
  }

  const Json& schema_;
  std::vector<KnownFigure> figures_;
};

/// Returns whether a figure is of one node or of the request: such a name is meant only if no other matches.
bool is_aside(const std::string& name) {
  return name.find('*') != std::string::npos || name.starts_with("host.") || name.starts_with("options.");
}

bool is_meant(const std::string& name, const std::string& typed) {
  return name == typed || name == typed + ".total" || name.ends_with("." + typed) || name.ends_with("." + typed + ".total");
}

std::vector<std::string> figures_meant(const std::string& typed, bool aside) {
  std::vector<std::string> meant;
  for (const auto& [name, unused] : known_figures()) {
    if (name.find('*') == std::string::npos && is_aside(name) == aside && is_meant(name, typed)) {
      meant.push_back(name);
    }
  }
  return meant;
}

/// Returns null if there is none.
const KnownFigure* find_figure(const std::string& name) {
  const std::vector<KnownFigure>& all = known_figures();
  return core::find_in(all, name, &KnownFigure::name);
}

/// Returns a question with the figure whose name or last word is near.
std::string question_about(const std::string& typed) {
  std::vector<std::string> words;
  for (const auto& [name, unused] : known_figures()) {
    if (!is_aside(name)) {
      words.push_back(name);
    }
  }
  if (const std::string meant = core::did_you_mean(typed, words); !meant.empty()) {
    return meant;
  }
  for (std::string& word : words) {
    word = word.substr(word.rfind('.') + 1);
  }
  return core::did_you_mean(typed, words);
}

}  // namespace

const std::vector<KnownFigure>& known_figures() {
  static const std::vector<KnownFigure> figures = [] {
    const Json schema = Json::parse(stats_schema());
    SchemaWalk walk(schema);
    walk.add(schema.at("$defs").at("render"), "");
    return walk.figures();
  }();
  return figures;
}

bool is_number(const std::string& name) {
  const KnownFigure* const figure = find_figure(name);
  return figure != nullptr && figure->is_number;
}

std::string figure_meant(const std::string& typed, const std::string& option) {
  for (const std::string& name : {typed, typed + ".total"}) {
    if (name.find('*') == std::string::npos && find_figure(name) != nullptr) {
      return name;
    }
  }
  for (const bool aside : {false, true}) {
    const std::vector<std::string> meant = figures_meant(typed, aside);
    if (meant.size() == 1) {
      return meant.front();
    }
    if (!meant.empty()) {
      throw core::UsageError(option + "=" + typed + ": this may be any of " + joined(meant, ", ") + "; expected one of them");
    }
  }
  throw core::UsageError(option + "=" + typed + ": there is no such figure in what --stats writes; expected its keys with dots " +
                         "between, such as pages.faults." + question_about(typed));
}

}  // namespace dmpc::apps
