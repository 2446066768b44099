// Texts that compare figures.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace dmpc::apps::html {

/// 0 if `whole` is 0.
double share_of(double part, double whole);

/// "41 %", "0.3 %", "less than 0.1 %".
std::string share_text(double share);

/// "1.80 times".
std::string times_text(double factor);

double sum_of(std::span<const double> values);
/// Index of the first of the largest values. Requires a value.
std::size_t largest_at(std::span<const double> values);

/// The share that the largest tenth of the values, at least one, has of their sum.
double top_tenth_share(std::vector<double> values);

/// How evenly values are distributed: "Node 3 did 1.80 times the mean". `what` goes between node and figure. Empty for one node,
/// or if all are zero.
std::string evenness(std::span<const double> values, const std::string& what);

}  // namespace dmpc::apps::html
