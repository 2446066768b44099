// What may be concluded from two runs, as types: no other code of `study systems` concludes anything.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dmpc::apps {

/// What two runs must share.
struct Circumstances {
  std::string scene, machine;
  std::uint64_t film_hash = 0;
  std::uint32_t node_count = 0;
  std::optional<std::size_t> memory_bytes;  ///< of each node; nothing: what its system needs

  bool operator==(const Circumstances&) const = default;
};

/// A run as verdicts see it.
struct ComparedRow {
  std::string name;  ///< "svm on extents"
  Circumstances circumstances;
  std::map<std::string, std::string> options;  ///< by name, without dashes: "homes" "spread"
  std::string search;                          ///< by which the options were found; empty: they were given
  double seconds = 0;
};

/// An option in which two rows differ; an empty text for a row that does not have it.
struct OptionDifference {
  std::string option, first, second;
};
/// An option that only one row has is one.
std::vector<OptionDifference> differences(const ComparedRow& first, const ComparedRow& second);

enum class Outcome : std::uint8_t { faster, slower, tie };

/// Times that differ by no more than this share are equal.
inline constexpr double time_tie_share = 0.01;
/// Of the first beside the second.
Outcome outcome_of(double first_seconds, double second_seconds);

/// The common part of both kinds of verdict.
class VerdictOnRows {
 public:
  Outcome outcome() const { return outcome_of(first_.seconds, second_.seconds); }

 protected:
  VerdictOnRows(ComparedRow first, ComparedRow second) : first_(std::move(first)), second_(std::move(second)) {}
  const Circumstances& circumstances() const { return first_.circumstances; }
  const ComparedRow& first() const { return first_; }
  const ComparedRow& second() const { return second_; }
  /// "64 nodes of hdr, 1.5 MiB each: svm on extents 1.3 ms, forest on extents 2.6 ms, 2.00 times as long".
  std::string times_text() const;

 private:
  ComparedRow first_, second_;
};

/// Two rows that differ in one named option.
class IsolatedVerdict : public VerdictOnRows {
 public:
  static bool may_compare(const ComparedRow& first, const ComparedRow& second);
  /// Throws core::InternalError unless may_compare().
  IsolatedVerdict(ComparedRow first, ComparedRow second);
  std::string sentence() const;

 private:
  OptionDifference difference_;
};

/// In how many draws of the machine's prices a row stayed ahead of another.
struct AheadInDraws {
  std::uint32_t count = 0, draws = 0;
  /// Fewer than 80 of 100.
  bool is_undecided() const { return count * 5 < draws * 4; }
};

/// Two rows, each the best that the same search has found, with all options in which they differ.
class BestVerdict : public VerdictOnRows {
 public:
  static constexpr const char* opening = "Best against best";
  /// Throws core::InternalError for rows of different circumstances, rows that were not searched, or not in the same way.
  BestVerdict(ComparedRow first, ComparedRow second, std::optional<AheadInDraws> ahead);
  std::string sentence() const;
  bool is_undecided() const { return ahead_ && ahead_->is_undecided(); }

 private:
  std::optional<AheadInDraws> ahead_;
};

}  // namespace dmpc::apps
