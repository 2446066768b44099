#include "apps/lab/study/paper/price_fit.h"

#include <cmath>
#include <utility>

#include "apps/frontend/machine/machines.h"
#include "core/trace/charge.h"

namespace dmpc::apps {
namespace {

constexpr std::size_t price_count = 3;
using PriceVector = std::array<double, price_count>;
using PriceMatrix = std::array<PriceVector, price_count>;

/// Returns nothing if the rows are linearly dependent.
std::optional<PriceVector> solution_of(PriceMatrix rows, PriceVector right) {
  constexpr double least_pivot = 1e-9;  // of rows scaled to a diagonal of 1
  for (std::size_t i = 0; i < price_count; ++i) {
    std::size_t pivot = i;
    for (std::size_t row = i + 1; row < price_count; ++row) {
      pivot = std::fabs(rows[row][i]) > std::fabs(rows[pivot][i]) ? row : pivot;
    }
    if (std::fabs(rows[pivot][i]) < least_pivot) {
      return std::nullopt;
    }
    std::swap(rows[i], rows[pivot]);
    std::swap(right[i], right[pivot]);
    for (std::size_t row = 0; row < price_count; ++row) {
      const double factor = row == i ? 0 : rows[row][i] / rows[i][i];
      for (std::size_t column = 0; column < price_count; ++column) {
        rows[row][column] -= factor * rows[i][column];
      }
      right[row] -= factor * right[i];
    }
  }
  for (std::size_t i = 0; i < price_count; ++i) {
    right[i] /= rows[i][i];
  }
  return right;
}

/// A cell's equation, divided by the printed value.
struct Equation {
  PriceVector factors;
  double right = 0;
};

Equation equation_of(const PricedCell& cell) {
  Equation equation{cell.time.per_price, (cell.printed - cell.time.rest) / cell.printed};
  for (double& factor : equation.factors) {
    factor /= cell.printed;
  }
  return equation;
}

double square_sum(std::span<const PricedCell> cells, const PriceVector& prices) {
  double sum = 0;
  for (const PricedCell& cell : cells) {
    const auto [factors, right] = equation_of(cell);
    double error = -right;
    for (std::size_t i = 0; i < price_count; ++i) {
      error += factors[i] * prices[i];
    }
    sum += error * error;
  }
  return sum;
}

/// Returns the best prices if only those with a bit in `used` are not 0.
std::optional<PriceVector> best_prices(std::span<const PricedCell> cells, unsigned used) {
  const auto is_used = [used](std::size_t i) { return (used >> i & 1U) != 0; };
  PriceMatrix normal{};
  PriceVector right{}, scale{};
  for (const PricedCell& cell : cells) {
    const auto [factors, goal] = equation_of(cell);
    for (std::size_t i = 0; i < price_count; ++i) {
      for (std::size_t j = 0; j < price_count; ++j) {
        normal[i][j] += is_used(i) && is_used(j) ? factors[i] * factors[j] : 0;
      }
      right[i] += is_used(i) ? factors[i] * goal : 0;
    }
  }
  for (std::size_t i = 0; i < price_count; ++i) {
    scale[i] = is_used(i) ? std::sqrt(normal[i][i]) : 1;
    normal[i][i] = is_used(i) ? normal[i][i] : 1;
    if (scale[i] == 0) {
      return std::nullopt;
    }
  }
  for (std::size_t i = 0; i < price_count; ++i) {
    right[i] /= scale[i];
    for (std::size_t j = 0; j < price_count; ++j) {
      normal[i][j] /= scale[i] * scale[j];
    }
  }
  auto prices = solution_of(normal, right);
  for (std::size_t i = 0; prices && i < price_count; ++i) {
    (*prices)[i] /= scale[i];
  }
  return prices;
}

bool is_feasible(const PriceVector& prices) {
  for (const double price : prices) {
    if (!(price >= 0)) {
      return false;
    }
  }
  return true;
}

double price_of(const VoxelPrices& prices, std::size_t index) {
  return index == 0 ? prices.walk : index == 1 ? prices.rays : prices.cached_lookup;
}

VoxelPrices unit_price(std::size_t index) {
  return {.walk = index == 0 ? 1.0 : 0, .rays = index == 1 ? 1.0 : 0, .cached_lookup = index == 2 ? 1.0 : 0};
}

}  // namespace

nodes::Machine voxel_machine(const VoxelPrices& prices) {
  nodes::Machine machine = find_machine_preset("ipsc2-1994")->machine;
  set_prices(machine, prices);
  return machine;
}

double RayTime::milliseconds(const VoxelPrices& prices) const {
  double sum = rest;
  for (std::size_t i = 0; i < price_count; ++i) {
    sum += per_price[i] * price_of(prices, i);
  }
  return sum;
}

RayTime ray_time_of(const PaperResult& result) {
  const auto part = [&](TimePart which) { return static_cast<double>(result.parts.ns[static_cast<std::size_t>(which)]); };
  const double computing = part(TimePart::computing), idle = part(TimePart::starvation) + part(TimePart::idle_at_end);
  const double longer = computing > 0 ? 1 + idle / computing : 1;
  const double rays = static_cast<double>(result.rays);
  RayTime time{.per_price = {}, .rest = 1e-6 * (static_cast<double>(result.parts.total_ns()) - computing - idle) / rays};
  // A voxel machine's prices, times a thousand since they are whole picoseconds.
  constexpr double unit = 1000;
  const auto milliseconds = [&](const VoxelPrices& prices) {
    return 1e-9 * static_cast<double>(voxel_machine(prices).price_ps({result.charges})) * longer / rays;
  };
  const double of_page = milliseconds({});  // independent of these prices
  for (std::size_t i = 0; i < price_count; ++i) {
    VoxelPrices prices = unit_price(i);
    prices = {unit * prices.walk, unit * prices.rays, unit * prices.cached_lookup};
    time.per_price[i] = (milliseconds(prices) - of_page) / unit;
  }
  time.rest += of_page;
  return time;
}

std::optional<VoxelPrices> fit_prices(std::span<const PricedCell> cells) {
  if (cells.empty()) {
    return std::nullopt;
  }
  PriceVector best{};
  for (unsigned used = 1; used < 1U << price_count; ++used) {
    const auto prices = best_prices(cells, used);
    if (prices && is_feasible(*prices) && square_sum(cells, *prices) < square_sum(cells, best)) {
      best = *prices;
    }
  }
  return VoxelPrices{best[0], best[1], best[2]};
}

}  // namespace dmpc::apps
