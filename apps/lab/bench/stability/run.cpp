#include "apps/lab/bench/stability/run.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "apps/lab/crowd/side_by_side.h"
#include "core/base/expect.h"
#include "core/base/sampling.h"

namespace dmpc::apps {
namespace {

constexpr std::uint64_t batch_rays = 1024;

std::uint64_t hash_of(const std::string& text) {
  std::uint64_t hash = text.size();
  for (const char letter : text) {
    hash = core::mix(hash + static_cast<unsigned char>(letter) + 0x9e3779b97f4a7c15ULL);
  }
  return hash;
}

/// Returns the row of a case; a new one for its first case.
KernelCounts& row_of(StabilityState& state, const std::string& name) {
  const auto found =
      std::find_if(state.rows.begin(), state.rows.end(), [&](const StabilityRow& row) { return row.name == name; });
  return found != state.rows.end() ? found->counts : state.rows.emplace_back(StabilityRow{name}).counts;
}

void run_case(const StabilityCase& one, std::uint64_t seed, StabilityState& state, const std::function<void()>& after_batch) {
  const ShootRays shoot_rays = one.prepare();
  const std::uint64_t key = core::mix(seed) ^ hash_of(one.row + "/" + one.name);
  KernelCounts& sum = row_of(state, one.row);
  StabilityCounts& of_case = state.trials.emplace_back(StabilityTrial{one.row, one.name}).counts;
  side_by_side((one.rays + batch_rays - 1) / batch_rays, [&](std::size_t index) -> std::function<void()> {
    const std::uint64_t first = index * batch_rays, count = std::min(batch_rays, one.rays - first);
    Random random(core::mix(key + first));
    const KernelCounts counts = shoot_rays(random, first, count);
    return [&state, &sum, &of_case, &after_batch, counts, count] {
      sum += counts;
      for (const StabilityCounts& of_kernel : counts) {
        of_case += of_kernel;
      }
      state.rays_done += count;
      after_batch();
    };
  });
}

}  // namespace

std::uint64_t StabilityState::own_failures() const {
  std::uint64_t sum = 0;
  for (const StabilityRow& row : rows) {
    for (std::size_t k = 0; k < row.counts.size(); ++k) {
      sum += is_embree(static_cast<StabilityKernel>(k)) ? 0 : row.counts[k].failures();
    }
  }
  return sum;
}

std::vector<std::string> StabilityState::blind_cases() const {
  std::vector<std::string> blind;
  for (std::size_t i = 0; i < cases_done; ++i) {
    if (trials[i].counts.tried == 0) {
      blind.push_back(trials[i].row + ", " + trials[i].name);
    }
  }
  return blind;
}

void run_stability(const StabilityCases& cases, std::uint64_t seed, StabilityState& state,
                   const std::function<void()>& after_batch) {
  for (const StabilityCase& one : cases) {
    run_case(one, seed, state, after_batch);
    ++state.cases_done;
  }
}

std::uint64_t total_rays(const StabilityCases& cases) {
  return std::accumulate(cases.begin(), cases.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const StabilityCase& one) { return sum + one.rays; });
}

StabilityCases stability_cases(const StabilityAmount& amount, const std::vector<std::string>& tests) {
  StabilityCases all;
  for (const auto make : {mesh_cases, axis_cases, plane_cases, insertion_cases, scene_cases, region_cases, child_cases,
                          hostile_cases, parity_cases, certificate_cases, quadric_cases}) {
    for (StabilityCase& one : make(amount)) {
      all.push_back(std::move(one));
    }
  }
  std::string names;
  for (std::size_t i = 0; i < all.size(); ++i) {
    names += i == 0 ? all[i].test() : all[i].test() != all[i - 1].test() ? ", " + all[i].test() : "";
  }
  for (const std::string& test : tests) {
    if (std::none_of(all.begin(), all.end(), [&](const StabilityCase& one) { return one.test() == test; })) {
      throw core::UsageError("--tests=" + test + ": expected some of " + names + " with commas between them");
    }
  }
  std::erase_if(all, [&](const StabilityCase& one) {
    return !tests.empty() && std::find(tests.begin(), tests.end(), one.test()) == tests.end();
  });
  return all;
}

}  // namespace dmpc::apps
