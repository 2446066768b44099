// One option: all that is known of it, in one row.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <variant>

#include "apps/frontend/line/command_line.h"
#include "core/base/refusal.h"

namespace dmpc::apps {

/// What --stats tells of an option: a flag, a number or a word; or nothing.
using OptionValue = std::variant<std::monostate, bool, std::uint64_t, std::string_view>;

/// What it may be.
enum class OptionKind : std::uint8_t { word, number, flag };

/// The field that an option sets, and how it is declared; `shown_default`: what help says of the default of a number.
template <class Options>
struct OptionField {
  using Declare =
      std::function<void(OptionSet set, const char* name, const char* help, Options& options, const std::string& shown_default)>;
  core::Field field;
  Declare declare;
  OptionKind kind = OptionKind::word;
};

template <class Options, class Plan>
struct OptionRow {
  const char* name;            ///< "--work-donor"
  OptionField<Options> takes;  ///< a field, and what it may be
  const char* help;
  const char* why;  ///< why strategies have no such field that have none; nullptr: it is not their strategy that matters
  const char* key;  ///< in --stats; nullptr where what became of it is told by whoever knows
  OptionValue (*reported)(const Plan& plan);  ///< what it became
  const char* meaning = "";                   ///< what the reported value means, where the key does not say it all

  void add_to(const OptionSet& set, Options& options, const std::string& shown_default = "") const {
    takes.declare(set, name, help, options, shown_default);
  }
};

template <class Member>
struct MemberOf;
template <class Struct, class Value>
struct MemberOf<Value Struct::*> {
  using type = Struct;
};
template <auto Member>
using StructOf = typename MemberOf<decltype(Member)>::type;

/// The field at the end of a way of members, one in the other: &BalanceOptions::bsp, &BspOptions::order.
template <auto First, auto... Rest>
consteval core::Field last_field_of() {
  if constexpr (sizeof...(Rest) == 0) {
    return core::field_of<First>();
  } else {
    return last_field_of<Rest...>();
  }
}

/// Whole numbers from `least` to `most`.
template <auto First, auto... Rest>
OptionField<StructOf<First>> number(std::int64_t least, std::int64_t most, const std::string& standard) {
  return {last_field_of<First, Rest...>(),
          [=](OptionSet set, const char* name, const char* help, StructOf<First>& options, const std::string& shown_default) {
            set.add_number(name, ((options.*First).*....*Rest), least, most, shown_default.empty() ? standard : shown_default,
                           help);
          },
          OptionKind::number};
}

/// One of some words, each with its meaning; the default is what the field is when the option is declared.
template <auto First, auto... Rest, class T>
OptionField<StructOf<First>> word(const OptionSet::Choices<T>& choices) {
  return {last_field_of<First, Rest...>(),
          [choices](OptionSet set, const char* name, const char* help, StructOf<First>& options, const std::string&) {
            set.add_choice<T>(name, ((options.*First).*....*Rest), choices, help);
          }};
}

template <auto First>
OptionField<StructOf<First>> flag() {
  return {core::field_of<First>(),
          [](OptionSet set, const char* name, const char* help, StructOf<First>& options, const std::string&) {
            set.add_flag(name, options.*First, help);
          },
          OptionKind::flag};
}

}  // namespace dmpc::apps
