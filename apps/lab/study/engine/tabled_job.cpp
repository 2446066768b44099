#include "apps/lab/study/engine/tabled_job.h"

#include <exception>
#include <iostream>
#include <memory>
#include <utility>

#include "apps/frontend/show/page/origin.h"
#include "apps/frontend/show/page/page.h"

namespace dmpc::apps {
namespace {

std::string page_of(const StudyFindings& findings) {
  const Origin origin = this_origin(findings.scene_digest);
  html::Page page(findings.title);
  page.add_text(origin.program + ", " + origin.date);
  page.add_conclusion(findings.conclusion);
  for (const Plot& plot : findings.plots) {
    page.add_plot(plot, findings.table);
  }
  page.add_table(findings.table);
  page.add_origin(origin, findings.facts);
  return page.text();
}

}  // namespace

int run_tabled(const TabledJob& job, Interrupt& interrupt) {
  std::exception_ptr failure;
  try {
    job.measure();
  } catch (...) {
    failure = std::current_exception();
  }
  Attempts attempts(std::cerr);
  if (!failure || (job.has_findings && job.has_findings())) {
    interrupt.set_consequence(job.consequence);
    job.write(!failure, attempts);
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
  return attempts.status();
}

int run_tabled(TabledJob job, const std::function<TableResult(bool is_whole)>& result, const TableFiles& files,
               Interrupt& interrupt, std::ostream& output) {
  job.write = [&](bool is_whole, Attempts& attempts) { files.write(result(is_whole), output, std::cerr, attempts); };
  return run_tabled(job, interrupt);
}

TableResult study_result(StudyFindings findings, TableFormat format) {
  std::string text = text_of(findings.table, format);
  const auto kept = std::make_shared<const StudyFindings>(std::move(findings));
  return {.text = std::move(text),
          .page = [kept] { return page_of(*kept); },
          .plotted =
              [kept] {
                return std::vector<PlottedTable>{{kept->table, kept->data_file, kept->plots}};
              }};
}

}  // namespace dmpc::apps
