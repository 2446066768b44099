#include "apps/lab/study/options.h"

#include "apps/edge/table/table_options.h"

namespace dmpc::apps {

void add_options(OptionSet set, StudyOptions& options) {
  std::visit([&](auto& study) { study.add_options({set, options.machine_name, options.database}); }, options.study);
  add_options(set, options.picture);
  add_transport_options(set, options.picture);
  add_options(set, options.database);
  add_options(set, options.table, TableExtras::plots_and_report);
  set.add_quiet(options.quiet);
}

}  // namespace dmpc::apps
