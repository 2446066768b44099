// The ablation of skips as a table, and as a picture of it.
#pragma once

#include <span>
#include <string>

#include "apps/edge/table/plot.h"
#include "apps/edge/table/table.h"
#include "apps/lab/bench/speed/ablation.h"

namespace dmpc::apps {

/// A row for each skip and scene that has been measured, in their order, and a sentence on each skip below.
Table table_of(std::span<const Ablation> ablations, const std::string& title);

/// What the picture is drawn from: without over with, by time and by counted work.
Table plotted_table(std::span<const Ablation> ablations);

/// Bars of counted work, a skip beside the other at each scene.
Plot plot_of_ablation(const Table& plotted, const std::string& name);

}  // namespace dmpc::apps
