#include "apps/lab/bench/stability/run.h"

#include <algorithm>
#include <utility>

#include "apps/lab/crowd/side_by_side.h"
#include "core/base/expect.h"
#include "core/base/sampling.h"

namespace dmpc::apps {
namespace {

constexpr std::uint64_t batch_rays = 1024;

/// The last of them may be short.
std::uint64_t batches_in(std::uint64_t rays) { return (rays + batch_rays - 1) / batch_rays; }

std::uint64_t hash_of(const std::string& text) {
  std::uint64_t hash = text.size();
  for (const char letter : text) {
    hash = core::mix(hash + static_cast<unsigned char>(letter) + 0x9e3779b97f4a7c15ULL);
  }
  return hash;
}

KernelCounts& row_of(StabilityState& state, const std::string& name) {
  const auto found =
      std::find_if(state.rows.begin(), state.rows.end(), [&](const StabilityRow& row) { return row.name == name; });
  core::expect(found != state.rows.end(), "every case has a row");
  return found->counts;
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
  for (std::size_t i = 0; i < std::min(case_index, trials.size()); ++i) {
    if (trials[i].counts.tried == 0) {
      blind.push_back(trials[i].row + ", " + trials[i].name);
    }
  }
  return blind;
}

StabilityRun::StabilityRun(StabilityCases cases, std::uint64_t seed) : cases_(std::move(cases)), seed_(seed) {}

StabilityState StabilityRun::start() const {
  StabilityState state;
  for (const StabilityCase& one : cases_) {
    if (std::none_of(state.rows.begin(), state.rows.end(), [&](const StabilityRow& row) { return row.name == one.row; })) {
      state.rows.push_back({one.row});
    }
    state.trials.push_back({one.row, one.name});
  }
  return state;
}

void StabilityRun::go_on(StabilityState& state, const std::function<void()>& after_batch) const {
  while (state.case_index < cases_.size()) {
    run_case(cases_[state.case_index], state, after_batch);
    ++state.case_index;
    state.rays_done = 0;
  }
}

void StabilityRun::run_case(const StabilityCase& one, StabilityState& state, const std::function<void()>& after_batch) const {
  core::expect(state.rays_done % batch_rays == 0 || state.rays_done == one.rays, "a run stops between batches");
  const ShootRays shoot_rays = one.prepare();
  const std::uint64_t first_batch = batches_in(state.rays_done), batches = batches_in(one.rays);
  const std::uint64_t key = core::mix(seed_) ^ hash_of(one.row + "/" + one.name);
  KernelCounts& sum = row_of(state, one.row);
  side_by_side(batches - first_batch, [&](std::size_t index) -> std::function<void()> {
    const std::uint64_t first = (first_batch + index) * batch_rays, count = std::min(batch_rays, one.rays - first);
    Random random(core::mix(key + first));
    const KernelCounts counts = shoot_rays(random, first, count);
    return [&state, &sum, &after_batch, counts, count] {
      sum += counts;
      for (const StabilityCounts& of_kernel : counts) {
        state.trials[state.case_index].counts += of_kernel;
      }
      state.rays_done += count;
      after_batch();
    };
  });
}

std::uint64_t StabilityRun::total_rays() const {
  std::uint64_t sum = 0;
  for (const StabilityCase& one : cases_) {
    sum += one.rays;
  }
  return sum;
}

std::uint64_t StabilityRun::rays_done(const StabilityState& state) const {
  std::uint64_t sum = state.rays_done;
  for (std::size_t i = 0; i < state.case_index; ++i) {
    sum += cases_[i].rays;
  }
  return sum;
}

std::string StabilityRun::place(const StabilityState& state) const {
  const StabilityCase& one = cases_[std::min(state.case_index, cases_.size() - 1)];
  return one.row + ", " + one.name;
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
