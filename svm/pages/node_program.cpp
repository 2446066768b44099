#include "svm/pages/node_program.h"

namespace dmpc::svm {

PageCounters& operator+=(PageCounters& sum, const PageCounters& more) {
  sum.references += more.references;
  sum.home_hits += more.home_hits;
  sum.cache_hits += more.cache_hits;
  sum.misses += more.misses;
  sum.faults += more.faults;
  sum.evictions += more.evictions;
  sum.served += more.served;
  sum.distinct_pages += more.distinct_pages;
  return sum;
}

WorkCounters& operator+=(WorkCounters& sum, const WorkCounters& more) {
  sum.pixels_rendered += more.pixels_rendered;
  sum.items_asked += more.items_asked;
  sum.items_taken += more.items_taken;
  sum.items_given += more.items_given;
  return sum;
}

QuestionCounters& operator+=(QuestionCounters& sum, const QuestionCounters& more) {
  sum.rays_asked += more.rays_asked;
  sum.records_asked += more.records_asked;
  sum.rays_answered += more.rays_answered;
  sum.records_answered += more.records_answered;
  sum.answers += more.answers;
  return sum;
}

}  // namespace dmpc::svm
