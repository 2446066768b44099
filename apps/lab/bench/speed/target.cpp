#include "apps/lab/bench/speed/target.h"

#include <algorithm>

#include "apps/edge/line/number_text.h"
#include "apps/edge/table/averages.h"
#include "apps/lab/bench/speed/recording.h"

namespace dmpc::apps {
namespace {

bool is_kernel(const Comparison& comparison, const char* subject) {
  return comparison.part == SpeedPart::kernel && comparison.threads == 1 && comparison.subject == subject &&
         comparison.rival == "Embree robust";
}

/// Whether it is of rays that a render shoots; bounces are a path tracer's.
bool is_rendered(const Comparison& comparison, const char* subject) {
  return is_kernel(comparison, subject) && comparison.detail != name_of(RayClass::bounce);
}

bool is_coherent(const Comparison& comparison, const char* subject) {
  return is_rendered(comparison, subject) && comparison.detail != name_of(RayClass::secondary);
}

bool is_of(const Comparison& comparison, SpeedPart part, const char* what, const char* subject) {
  return comparison.part == part && comparison.what == what && comparison.subject == subject;
}

/// As is_of(), and what is timed by two clocks only by the wall clock: what the user waits for counts.
bool is_timed(const Comparison& comparison, SpeedPart part, const char* what, const char* subject) {
  return comparison.is_by_wall_clock() && is_of(comparison, part, what, subject);
}

using C = Comparison;

std::vector<Target> kernel_targets() {
  return {
      {.name = "Kernel over Embree robust, records local, one thread",
       .reach = 0.75,
       .goal = 1.0,
       .is_more_better = true,
       .counts = [](const C& c) { return is_kernel(c, "grid"); }},
      {.name = "Kernel over Embree robust, through the pager with every page cached, one thread",
       .reach = 0.65,
       .goal = 0.9,
       .is_more_better = true,
       .counts = [](const C& c) { return is_kernel(c, "paged grid"); }},
      {.name = "Kernel in bundles over Embree robust, records local, primary and shadow, one thread",
       .reach = 1.2,
       .goal = 1.8,
       .is_more_better = true,
       .counts = [](const C& c) { return is_coherent(c, "bundles"); }},
      {.name = "Kernel in bundles over Embree robust, records local, all rays, one thread",
       .reach = 1.0,
       .goal = 1.2,
       .is_more_better = true,
       .counts = [](const C& c) { return is_rendered(c, "bundles"); }},
      {.name = "Kernel in bundles over Embree robust, through the pager with every page cached, all rays, one thread",
       .reach = 0.95,
       .goal = 1.1,
       .is_more_better = true,
       .counts = [](const C& c) { return is_rendered(c, "paged bundles"); }},
  };
}

/// A whole command, or a phase `render`, whose processor time is held against the plain renderer's.
Target cost(const char* what, const char* subject, double reach, double goal) {
  return {.name = std::string(subject) + ", " + (std::string(what) == "command" ? "whole command" : "render") +
                  " over plain, processor time",
          .reach = reach,
          .goal = goal,
          .counts = [what, subject](const C& c) {
            return is_of(c, SpeedPart::plain, what, subject) && c.detail == "processor time";
          }};
}

/// Two of ours, by the wall clock.
Target pair(const char* subject, const char* rival, double reach, double goal) {
  return {.name = std::string(subject) + " over " + rival + ", render, wall clock",
          .reach = reach,
          .goal = goal,
          .counts = [subject, rival](const C& c) { return is_timed(c, SpeedPart::plain, "pair", subject) && c.rival == rival; }};
}

std::vector<Target> cost_targets() {
  return {
      cost("command", "svm on 1 node", 1.20, 1.0),
      cost("render", "svm on 1 node", 0.90, 0.7),
      cost("command", "svm on 2 nodes", 1.25, 1.0),
      cost("render", "svm on 2 nodes", 1.05, 0.8),
      cost("command", "svm on 64 nodes", 2.0, 1.3),
      cost("command", "svm on 64 nodes, pool", 1.6, 1.3),
      cost("render", "svm on 64 nodes, pool", 1.45, 1.3),
      cost("command", "svm on 64 nodes, pool, beside 8 busy", 1.9, 1.5),
      cost("command", "dataflow on 64 nodes, pool", 4.0, 2.5),
      {.name = "Writing the file, share of the command's processor time, svm on 2 nodes",
       .reach = 0.08,
       .goal = 0.03,
       .counts = [](const C& c) { return is_of(c, SpeedPart::plain, "writing", "picture file"); }},
  };
}

std::vector<Target> pair_targets() {
  Target scaling = pair("svm on 1 node", "svm on 2 nodes", 1.8, 1.9);
  scaling.is_more_better = true;
  Target many = pair("svm on 64 nodes", "svm on 2 nodes", 1.5, 1.2);
  Target many_in_pool = pair("svm on 64 nodes, pool", "svm on 2 nodes, pool", 1.5, 1.2);
  many.is_worst = many_in_pool.is_worst = true;
  return {{.name = "svm on 2 nodes over plain on 2 threads, render, wall clock",
           .reach = 1.1,
           .goal = 0.9,
           .counts = [](const C& c) { return is_timed(c, SpeedPart::plain, "render", "svm on 2 nodes"); }},
          scaling,
          many,
          many_in_pool,
          pair("dataflow on 2 nodes", "svm on 2 nodes", 1.15, 1.0),
          pair("dataflow on 2 nodes, pool", "svm on 2 nodes, pool", 1.15, 1.0),
          pair("dataflow on 64 nodes", "svm on 64 nodes", 1.6, 1.2),
          pair("dataflow on 64 nodes, pool", "svm on 64 nodes, pool", 1.6, 1.2),
          {.name = "dataflow on 2 nodes over 2 ranks over one process, render, wall clock",
           .reach = 1.3,
           .goal = 1.1,
           .counts = [](const C& c) { return is_timed(c, SpeedPart::plain, "ranks", "dataflow on 2 nodes, 2 ranks"); }}};
}

/// At equal error, which the same samples have.
Target path_cost(const char* subject, double reach, double goal) {
  return {.name = std::string(subject) + " over a plain path tracer on as many threads, render, processor time",
          .reach = reach,
          .goal = goal,
          .counts = [subject](const C& c) { return is_of(c, SpeedPart::paths, "render", subject); }};
}

std::vector<Target> path_targets() {
  return {path_cost("replicated on 1 node", 1.4, 1.2), path_cost("svm on 2 nodes", 1.6, 1.3)};
}

std::vector<Target> other_targets() {
  return {
      {.name = "Whole picture on 2 nodes over the same with --tracer=embree",
       .reach = 1.3,
       .goal = 1.0,
       .counts = [](const C& c) { return is_timed(c, SpeedPart::picture, "whole picture", "svm"); }},
      {.name = "64 nodes over 2 on the same cores, pages fit",
       .reach = 1.3,
       .goal = 1.15,
       .counts = [](const C& c) { return is_timed(c, SpeedPart::emulation, "nodes", "svm on 64 nodes"); }},
      {.name = "8 nodes with a cache of 10 % of the database over 100 %",
       .reach = 1.6,
       .goal = 1.3,
       .counts = [](const C& c) { return is_timed(c, SpeedPart::emulation, "cache", "10 %"); }},
      {.name = "Database build over Embree's of its tree, robust, default quality, a million triangles, same threads",
       .reach = 2.0,
       .goal = 1.2,
       .is_worst = true,
       .counts = [](const C& c) { return c.part == SpeedPart::build && c.scene == "tetra-10" && c.rival == "Embree robust"; }},
      {.name = "Loading a PLY or GLB file over Assimp's reading it, wall clock",
       .reach = 1.0,
       .goal = 0.5,
       .is_worst = true,
       .counts = [](const C& c) { return c.part == SpeedPart::load; }},
      {.name = "Database KB over the article's",
       .reach = 1.0,
       .goal = 0.5,
       .is_worst = true,
       .counts = [](const C& c) { return is_of(c, SpeedPart::pages, "database", "here"); }},
      {.name = "Distinct pages a pixel over the article's",
       .reach = 1.0,
       .goal = 0.5,
       .is_worst = true,
       .counts = [](const C& c) { return is_of(c, SpeedPart::pages, "distinct pages a pixel", "here"); }},
      {.name = "Anonymous memory above an empty run's over the sum of the local memories",
       .reach = 1.3,
       .goal = 1.1,
       .is_worst = true,
       .counts = [](const C& c) { return c.part == SpeedPart::memory; }},
  };
}

}  // namespace

const std::vector<Target>& speed_targets() {
  static const std::vector<Target> targets = [] {
    std::vector<Target> all;
    for (const std::vector<Target>& some : {cost_targets(), pair_targets(), path_targets(), kernel_targets(), other_targets()}) {
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }();
  return targets;
}

std::optional<double> figure_of(const Target& target, std::span<const Comparison> comparisons) {
  const std::vector<double> ratios = ratios_of(measured(comparisons, target.counts));
  if (ratios.empty() || !target.is_worst) {
    return geometric_mean(ratios);
  }
  return target.is_more_better ? *std::min_element(ratios.begin(), ratios.end())
                               : *std::max_element(ratios.begin(), ratios.end());
}

std::optional<std::string> sentence_on(const Target& target, std::span<const Comparison> comparisons) {
  const std::optional<double> figure = figure_of(target, comparisons);
  if (!figure) {
    return std::nullopt;
  }
  const std::size_t count = measured(comparisons, target.counts).size();
  const auto meets = [&](double bound) { return target.is_more_better ? *figure >= bound : *figure <= bound; };
  const std::string verdict = meets(target.goal) ? "met, goal too" : meets(target.reach) ? "met" : "missed";
  return target.name + " (" + (target.is_worst ? "worst of " : "geometric mean of ") + std::to_string(count) +
         "): " + fixed(*figure, 3) + "; to reach " + fixed(target.reach, 2) + ", goal " + fixed(target.goal, 2) + ": " + verdict +
         ".";
}

}  // namespace dmpc::apps
