// What the figures of a render come to: a sentence or two for each section of its page, empty where there is nothing to say.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "apps/run/render_record.h"
#include "apps/run/report.h"
#include "apps/run/run_view.h"
#include "apps/show/heat/field.h"

namespace dmpc::apps::html {

/// How evenly something is shared out: "Node 3 did 1.80 times the mean's work". `what` goes between node and figure.
std::string evenness(std::span<const double> values, const std::string& what);

std::string loss_conclusion(const Account& account);
std::string time_conclusion(const nodes::ActivitySteps& steps);
std::string page_conclusion(const svm::PageCounters& pages, const svm::Fetches& fetches);
std::string fetch_conclusion(const svm::Fetches& fetches);
std::string cache_conclusion(const MissEstimate& misses, std::uint32_t cache_pages, std::uint32_t page_count);
/// `rays`: from a node (row) to an owner (column); `shot`: all rays.
std::string ray_conclusion(std::span<const std::uint64_t> rays, std::uint64_t shot);
std::string node_conclusion(const Account& account);
std::string traffic_conclusion(const Account& account);
std::string memory_conclusion(const Account& account, std::size_t database_bytes);
/// Of what adds up over pixels.
std::string heat_conclusion(const HeatField& field);

}  // namespace dmpc::apps::html
