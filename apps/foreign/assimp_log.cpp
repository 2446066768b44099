#include "apps/foreign/assimp_log.h"

#include <algorithm>
#include <array>
#include <assimp/DefaultLogger.hpp>
#include <assimp/Logger.hpp>
#include <cctype>
#include <cstdint>
#include <string_view>

#include "apps/edge/line/number_text.h"
#include "apps/edge/line/shown_text.h"
#include "apps/foreign/mesh/count_note.h"

namespace dmpc::apps {
namespace {

/// Words of which no picture is another.
constexpr std::array harmless{
    std::string_view("Collada: unable to determine UV channel for texture"),  // it is found by collada_in_full()
    std::string_view("Collada: No material specified for subgroup <=>"),      // which is grey in all formats
    std::string_view("AC3D: No material has been found"),
    std::string_view("FBX: no material assigned to mesh, setting default material"),
    std::string_view("FBX-DOM: unsupported, newer format version"),  // any of this decade, which it reads
    std::string_view("FBX: ignoring additional tangent layer"),
    std::string_view("FBX: ignoring additional binormal layer"),
    std::string_view("ScenePreprocessor: UVs are declared to be 3D"),
};

/// Without digits and what stands in quotes or angles.
std::string kind_of(std::string_view words) {
  std::string kind;
  char closing = 0;
  for (const char letter : words) {
    if (closing != 0) {
      closing = letter == closing ? 0 : closing;
    } else if (letter == '"' || letter == '<') {
      closing = letter == '<' ? '>' : letter;
    } else if (std::isdigit(static_cast<unsigned char>(letter)) == 0) {
      kind += letter;
    }
  }
  return kind;
}

/// Without a point at the end, and the sign that collada_in_full() puts before symbols.
std::string shown_words(std::string_view words) {
  std::string text = clipped(words.substr(0, words.find_last_not_of(". \n") + 1), 160);
  const std::size_t sign = text.find("<=");
  return sign == std::string::npos ? text : text.erase(sign + 1, 1);
}

}  // namespace

struct AssimpLog::Collector final : Assimp::Logger {
  struct Kind {
    std::string kind, first;
    std::uint64_t count;
  };
  static constexpr std::size_t kinds_max = 8;
  std::vector<Kind> kinds;
  std::uint64_t others = 0;

  void add(std::string_view words) {
    if (std::any_of(harmless.begin(), harmless.end(), [&](std::string_view one) { return words.starts_with(one); })) {
      return;
    }
    std::string kind = kind_of(words.substr(0, 1000));
    const auto known = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& one) { return one.kind == kind; });
    if (known != kinds.end()) {
      ++known->count;
    } else if (kinds.size() < kinds_max) {
      kinds.push_back({std::move(kind), shown_words(words), 1});
    } else {
      ++others;
    }
  }
  bool attachStream(Assimp::LogStream* /*stream*/, unsigned /*severity*/) override { return false; }
  bool detachStream(Assimp::LogStream* /*stream*/, unsigned /*severity*/) override { return false; }
  void OnDebug(const char* /*words*/) override {}
  void OnVerboseDebug(const char* /*words*/) override {}
  void OnInfo(const char* /*words*/) override {}
  void OnWarn(const char* words) override { add(words); }
  void OnError(const char* words) override { add(words); }
};

AssimpLog::AssimpLog() : collector_(new Collector) { Assimp::DefaultLogger::set(collector_); }

AssimpLog::~AssimpLog() { Assimp::DefaultLogger::set(nullptr); }

void AssimpLog::note(std::vector<std::string>& notes) const {
  for (const Collector::Kind& kind : collector_->kinds) {
    note_count(notes, "Assimp says: " + kind.first, kind.count);
  }
  note_count(notes, "more that Assimp says", collector_->others);
}

}  // namespace dmpc::apps
