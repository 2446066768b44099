#include "apps/frontend/machine/drawn_machine.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>

#include "apps/frontend/line/words.h"
#include "core/base/sampling.h"
#include "core/trace/charge.h"

namespace dmpc::apps {
namespace {

using nodes::Machine;
using nodes::MessageCost;
using Prices = std::vector<std::uint64_t*>;

constexpr const char* of_processor = "processor";

bool has_word(std::string_view text, std::string_view word) {
  const auto is_letter = [&](std::size_t at) {
    return at < text.size() && std::isalpha(static_cast<unsigned char>(text[at])) != 0;
  };
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    if ((at == 0 || !is_letter(at - 1)) && !is_letter(at + word.size())) {
      return true;
    }
  }
  return false;
}

/// 0 if the clause does not say.
double doubt_in(std::string_view clause) {
  constexpr std::array<std::pair<const char*, double>, 3> doubts = {{{"low", 2}, {"medium", 1.3}, {"high", 1.1}}};
  const auto* const found =
      std::find_if(doubts.begin(), doubts.end(), [&](const auto& row) { return has_word(clause, row.first); });
  return found == doubts.end() ? 0 : found->second;
}

bool names_a_part(std::string_view clause) {
  return has_word(clause, of_processor) || std::any_of(core::charge_names.begin(), core::charge_names.end(),
                                                       [&](std::string_view name) { return has_word(clause, name); });
}

/// The doubt of the clauses that are meant; 0 if none of them says.
template <class IsMeant>
double doubt_of_clauses(std::string_view source, const IsMeant& is_meant) {
  double doubt = 0;
  for (const std::string& clause : words_between(std::string(source), ';')) {
    doubt = is_meant(clause) ? std::max(doubt, doubt_in(clause)) : doubt;
  }
  return doubt;
}

double doubt_of_part(std::string_view source, std::string_view part) {
  return part.empty() ? 0 : doubt_of_clauses(source, [&](std::string_view clause) { return has_word(clause, part); });
}

std::string_view source_of(const MachineDescription& description, std::string_view key) {
  const auto found =
      std::find_if(description.sources.begin(), description.sources.end(), [&](const auto& one) { return one.first == key; });
  return found == description.sources.end() ? std::string_view() : std::string_view(found->second);
}

/// From -1 to 1.
double exponent(std::uint32_t draw, std::string_view price) {
  std::uint64_t bits = core::mix(draw_seed + draw);
  for (const char letter : price) {
    bits = core::mix(bits ^ static_cast<unsigned char>(letter));
  }
  return std::ldexp(static_cast<double>(bits >> 11U), -52) - 1;
}

/// Multiplies prices, in one draw.
class Draw {
 public:
  Draw(const MachineDescription& description, std::uint32_t draw) : description_(description), draw_(draw) {}

  void scale(const std::string& key, const std::string& part, const Prices& prices) const {
    const double factor = std::pow(doubt_of(source_of(description_, key), part), exponent(draw_, key + " " + part));
    for (std::uint64_t* const price : prices) {
      *price = static_cast<std::uint64_t>(std::llround(factor * static_cast<double>(*price)));
    }
  }
  void scale_message(const std::string& key, MessageCost& cost) const {
    scale(key, of_processor, {&cost.send_ns, &cost.receive_ns});
    scale(key, "", {&cost.latency_ns, &cost.byte_ps});
  }
  void scale_operations(Machine& machine) const {
    Prices together;
    for (std::size_t i = 0; i < machine.cost_ps.size(); ++i) {
      const std::string name(core::charge_names[i]);
      const bool has_own_source = !source_of(description_, name).empty();
      if (has_own_source || doubt_of_part(source_of(description_, "operation_ps"), name) > 0) {
        scale(has_own_source ? name : "operation_ps", name, {&machine.cost_ps[i]});
      } else {
        together.push_back(&machine.cost_ps[i]);
      }
    }
    scale("operation_ps", "", together);
  }

 private:
  const MachineDescription& description_;
  std::uint32_t draw_;
};

}  // namespace

double doubt_of(std::string_view source, std::string_view part) {
  constexpr double most = 2;
  const double of_part = doubt_of_part(source, part);
  const double of_rest = doubt_of_clauses(source, [](std::string_view clause) { return !names_a_part(clause); });
  const double of_all = doubt_of_clauses(source, [](std::string_view) { return true; });
  return of_part > 0 ? of_part : of_rest > 0 ? of_rest : of_all > 0 ? of_all : most;
}

Machine drawn(const MachineDescription& description, std::uint32_t number) {
  Machine machine = description.machine;
  const Draw draw(description, number);
  draw.scale_message("short_message", machine.short_message);
  draw.scale_message("long_message", machine.long_message);
  draw.scale("hop_ns", "", {&machine.hop_ns});
  draw.scale("service_ns", "", {&machine.service_ns});
  draw.scale_operations(machine);
  return machine;
}

}  // namespace dmpc::apps
