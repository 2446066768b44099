#include "apps/frontend/picture/color_map.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace dmpc::apps {

namespace {

/// Linear light at equal steps, as OpenImageIO has it; between them a straight line is as good.
constexpr std::array<core::Color, 17> inferno = {{
    {0.000113F, 0.000036F, 0.001073F},
    {0.003275F, 0.002178F, 0.017634F},
    {0.015183F, 0.003697F, 0.068760F},
    {0.046307F, 0.002834F, 0.130327F},
    {0.095494F, 0.005137F, 0.154432F},
    {0.163601F, 0.009920F, 0.156097F},
    {0.253890F, 0.016282F, 0.143715F},
    {0.367418F, 0.024893F, 0.119982F},
    {0.500495F, 0.038279F, 0.089117F},
    {0.642469F, 0.061553F, 0.057555F},
    {0.776190F, 0.102517F, 0.031141F},
    {0.883568F, 0.169990F, 0.012559F},
    {0.951614F, 0.271639F, 0.002704F},
    {0.972636F, 0.413571F, 0.005451F},
    {0.943272F, 0.599923F, 0.035112F},
    {0.884900F, 0.822282F, 0.140466F},
    {0.973729F, 0.996282F, 0.373522F},
}};

}  // namespace

core::Color color_map(double position) {
  const double place = (position > 0 ? std::min(position, 1.0) : 0.0) * (inferno.size() - 1);
  const auto below = static_cast<std::size_t>(place), above = std::min(below + 1, inferno.size() - 1);
  const auto share = static_cast<float>(place - static_cast<double>(below));
  return inferno[below] * (1 - share) + inferno[above] * share;
}

}  // namespace dmpc::apps
