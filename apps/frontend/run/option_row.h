// A row with all properties of an option.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <variant>

#include "apps/frontend/line/command_line.h"
#include "core/base/refusal.h"

namespace dmpc::apps {

/// The value of an option in --stats: a flag, a number or a word; or nothing.
using OptionValue = std::variant<std::monostate, bool, std::uint64_t, std::string_view>;

enum class OptionKind : std::uint8_t { word, number, flag };

/// The field that an option sets, and its declaration; help shows `shown_default` as the default of a number.
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
  OptionField<Options> takes;  ///< the field and its kind
  const char* help;
  const char* why;  ///< why other strategies have no such field; nullptr: it does not depend on the strategy
  const char* key;  ///< in --stats; nullptr where the value is reported elsewhere
  OptionValue (*reported)(const Plan& plan);  ///< the value in effect
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

/// The field at the end of a chain of members: &BalanceOptions::bsp, &BspOptions::order.
template <auto First, auto... Rest>
consteval core::Field last_field_of() {
  if constexpr (sizeof...(Rest) == 0) {
    return core::field_of<First>();
  } else {
    return last_field_of<Rest...>();
  }
}

/// Integers from `least` to `most`.
template <auto First, auto... Rest>
OptionField<StructOf<First>> number(std::int64_t least, std::int64_t most, const std::string& standard) {
  return {last_field_of<First, Rest...>(),
          [=](OptionSet set, const char* name, const char* help, StructOf<First>& options, const std::string& shown_default) {
            set.add_number(name, ((options.*First).*....*Rest), least, most, shown_default.empty() ? standard : shown_default,
                           help);
          },
          OptionKind::number};
}

/// One of several words, each with its meaning; the default is the field's value when the option is declared.
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
