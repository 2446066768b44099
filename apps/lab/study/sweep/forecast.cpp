#include "apps/lab/study/sweep/forecast.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string>

#include "apps/frontend/system/scratch_folder.h"
#include "apps/frontend/system/text_input.h"
#include "apps/lab/study/engine/render_process.h"

namespace dmpc::apps {
namespace {

constexpr const char* cache_option = "--cache-pages";

bool varies_caches_alone(const SweepSettings& settings) {
  return std::all_of(settings.variations.begin(), settings.variations.end(), [](const VariedOption& variation) {
    return (variation.option == cache_option) == (variation.values.size() > 1);
  });
}

/// The forecast of a run for which there was enough memory.
html::MadeRun made_run(const SweepResult& result) {
  constexpr double ns_a_second = 1e9;
  return {static_cast<std::uint32_t>(needed_number(*result.figures, "options.cache_pages")),
          needed_number(*result.figures, "virtual_seconds.total") * ns_a_second};
}

std::string text_in(const std::filesystem::path& file) {
  TextInput stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

std::optional<std::size_t> predicting_run(const SweepSettings& settings, const std::vector<SweepResult>& results) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const RenderOptions& options = results[i].run.options;
    if (results[i].figures && options.strategy == Strategy::svm && options.runner.kind == RunnerKind::virtual_time) {
      found.push_back(i);
    }
  }
  if (!varies_caches_alone(settings) || found.size() < 2) {
    return std::nullopt;
  }
  std::stable_sort(found.begin(), found.end(), [&](std::size_t a, std::size_t b) {
    return made_run(results[a]).cache_pages < made_run(results[b]).cache_pages;
  });
  return found[found.size() / 2];
}

std::optional<html::ForecastView> sweep_forecast(const SweepSettings& settings, const std::vector<SweepResult>& results,
                                                 const Interrupt& interrupt) {
  const std::optional<std::size_t> number = predicting_run(settings, results);
  if (!number) {
    return std::nullopt;
  }
  const ScratchFolder folder;
  const std::filesystem::path page = folder / "page.html";
  std::vector<std::string> words = results[*number].run.words;
  words.push_back("--report=" + page.string());
  RenderProcesses(settings.program, interrupt).run(words, "forecast");
  std::optional<html::ForecastView> view = html::forecast_in(text_in(page), page.string());
  if (view) {
    view->runs.clear();
    for (const SweepResult& result : results) {
      if (result.figures) {
        view->runs.push_back(made_run(result));
      }
    }
  }
  return view;
}

}  // namespace dmpc::apps
