#include "apps/edge/show/trace/paje.h"

#include <algorithm>
#include <iterator>
#include <ostream>
#include <tuple>

namespace dmpc::apps {

namespace {

/// In which order moments of one time are written: what ends before what begins, and a message's beginning before its end.
int rank_of(TraceMoment moment) {
  switch (moment) {
    case TraceMoment::span_end:
      return 0;
    case TraceMoment::span_begin:
      return 1;
    case TraceMoment::sent:
      return 2;
    case TraceMoment::received:
      return 3;
    default:
      return 4;
  }
}

/// The events that we use, by number: what Paje calls each, and its fields with their types.
constexpr const char* definitions =
    "%EventDef PajeDefineContainerType 0\n% Alias string\n% Type string\n% Name string\n%EndEventDef\n"
    "%EventDef PajeDefineStateType 1\n% Alias string\n% Type string\n% Name string\n%EndEventDef\n"
    "%EventDef PajeDefineVariableType 2\n% Alias string\n% Type string\n% Name string\n% Color color\n%EndEventDef\n"
    "%EventDef PajeDefineLinkType 3\n% Alias string\n% Type string\n% StartContainerType string\n"
    "% EndContainerType string\n% Name string\n%EndEventDef\n"
    "%EventDef PajeDefineEntityValue 4\n% Alias string\n% Type string\n% Name string\n% Color color\n%EndEventDef\n"
    "%EventDef PajeCreateContainer 5\n% Time date\n% Alias string\n% Type string\n% Container string\n% Name string\n"
    "%EndEventDef\n"
    "%EventDef PajeDestroyContainer 6\n% Time date\n% Type string\n% Name string\n%EndEventDef\n"
    "%EventDef PajePushState 7\n% Time date\n% Type string\n% Container string\n% Value string\n%EndEventDef\n"
    "%EventDef PajePopState 8\n% Time date\n% Type string\n% Container string\n%EndEventDef\n"
    "%EventDef PajeSetVariable 9\n% Time date\n% Type string\n% Container string\n% Value double\n%EndEventDef\n"
    "%EventDef PajeStartLink 10\n% Time date\n% Type string\n% Container string\n% StartContainer string\n% Value string\n"
    "% Key string\n%EndEventDef\n"
    "%EventDef PajeEndLink 11\n% Time date\n% Type string\n% Container string\n% EndContainer string\n% Value string\n"
    "% Key string\n%EndEventDef\n";

/// The colour of each SpanName.
constexpr const char* colors[] = {"0.27 0.51 0.71", "0.95 0.61 0.18", "0.46 0.72 0.38", "0.60 0.48 0.74", "0.74 0.62 0.84",
                                  "0.65 0.65 0.65", "0.84 0.24 0.31", "0.35 0.35 0.35", "0.80 0.80 0.50"};
static_assert(std::size(colors) == span_names.size());

std::string decimal_seconds(std::uint64_t time_ns) {
  const std::string rest = std::to_string(time_ns % 1'000'000'000);
  return std::to_string(time_ns / 1'000'000'000) + "." + std::string(9 - rest.size(), '0') + rest;
}

class PajeWriter {
 public:
  PajeWriter(const TraceView& view, std::ostream& output) : view_(view), output_(output) { find_level_names(); }

  void write() {
    output_ << "# clock: " << view_.clock << '\n';
    for (const auto& [name, text] : view_.remarks) {
      output_ << "# " << name << ": " << text << '\n';
    }
    output_ << definitions;
    define_types();
    for (std::size_t node = 0; node < view_.trace.nodes.size(); ++node) {
      output_ << "5 0.000000000 " << alias(node) << " N R \"" << node_name(view_, node) << "\"\n";
    }
    const std::vector<TraceItem> all = items();
    for (const TraceItem& item : all) {
      write(item);
    }
    const std::string end = decimal_seconds(all.empty() ? 0 : all.back().time_ns);
    for (std::size_t node = 0; node < view_.trace.nodes.size(); ++node) {
      output_ << "6 " << end << " N " << alias(node) << '\n';
    }
    output_ << "6 " << end << " M R\n";
  }

 private:
  static std::string alias(std::size_t node) { return "n" + std::to_string(node); }

  void define_types() {
    output_ << "0 M 0 \"computer, " << view_.clock << "\"\n0 N M \"node\"\n1 S N \"activity\"\n3 L M N N \"message\"\n";
    const std::vector<const char*> texts = view_.span_texts();
    for (std::size_t i = 0; i < texts.size(); ++i) {
      if (texts[i] != nullptr) {
        output_ << "4 s" << i << " S \"" << texts[i] << "\" \"" << colors[i % std::size(colors)] << "\"\n";
      }
    }
    for (std::size_t kind = 0; kind < view_.kind_names.size(); ++kind) {
      output_ << "4 k" << kind << " L \"" << view_.kind_names[kind] << "\" \"0.5 0.5 0.5\"\n";
    }
    for (std::size_t i = 0; i < level_names_.size(); ++i) {
      output_ << "2 v" << i << " N \"" << level_names_[i] << "\" \"0.2 0.4 0.8\"\n";
    }
    output_ << "5 0.000000000 R M 0 \"computer\"\n";
  }

  void find_level_names() {
    for (const nodes::TraceNode& node : view_.trace.nodes) {
      for (const std::string_view name : node.level_names) {
        if (std::find(level_names_.begin(), level_names_.end(), name) == level_names_.end()) {
          level_names_.push_back(name);
        }
      }
    }
  }

  std::vector<TraceItem> items() const {
    std::vector<TraceItem> items = items_of(view_.trace, {});
    std::sort(items.begin(), items.end(), [](const TraceItem& a, const TraceItem& b) {
      return std::tuple(a.time_ns, rank_of(a.moment), a.node, a.index) <
             std::tuple(b.time_ns, rank_of(b.moment), b.node, b.index);
    });
    return items;
  }

  void write(const TraceItem& item) {
    switch (item.moment) {
      case TraceMoment::span_begin:
      case TraceMoment::span_end:
        return write_state(item);
      case TraceMoment::sent:
      case TraceMoment::received:
        return write_link(item);
      case TraceMoment::level:
        return write_level(item);
      default:
        return;
    }
  }

  void write_state(const TraceItem& item) {
    const nodes::TraceSpan& span = view_.trace.nodes[item.node].spans[item.index];
    if (span.begin_ns == span.end_ns) {
      return;
    }
    const bool begins = item.moment == TraceMoment::span_begin;
    output_ << (begins ? "7 " : "8 ") << decimal_seconds(item.time_ns) << " S " << alias(item.node);
    if (begins) {
      output_ << " s" << view_.text_number(span);
    }
    output_ << '\n';
  }

  void write_link(const TraceItem& item) {
    const bool begins = item.moment == TraceMoment::sent;
    output_ << (begins ? "10 " : "11 ") << decimal_seconds(item.time_ns) << " L R " << alias(item.node) << " k"
            << std::size_t{view_.trace.messages[item.index].kind} << " m" << item.index << '\n';
  }

  void write_level(const TraceItem& item) {
    const nodes::TraceNode& node = view_.trace.nodes[item.node];
    const nodes::TraceLevel& level = node.levels[item.index];
    const auto name = std::find(level_names_.begin(), level_names_.end(), node.level_names[level.number]);
    output_ << "9 " << decimal_seconds(item.time_ns) << " v" << name - level_names_.begin() << ' ' << alias(item.node) << ' '
            << level.value << '\n';
  }

  const TraceView& view_;
  std::ostream& output_;
  std::vector<std::string_view> level_names_;  ///< of all nodes and the host, each once
};

}  // namespace

void write_paje(const TraceView& view, std::ostream& output) { PajeWriter(view, output).write(); }

}  // namespace dmpc::apps
