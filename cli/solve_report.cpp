// The report of a solve (solve_report.h). CLI: public headers only.
#include "solve_report.h"

#include <cmath>
#include <cstdio>

#include "exit_code.h"
#include "json.h"
#include "numbers.h"
#include "text_table.h"

namespace hrad::cli {
namespace {

constexpr const char* message_kinds[] = {"R", "U", "T"};

std::string percent_text(double share) { return short_text(100 * share, 3) + " %"; }

void append_counts(std::string* text, const SolveReport& report) {
  const hrad_stats& stats = report.stats;
  TextTable table("ll");
  table.add_row({"scene", report.scene});
  table.add_row({"status", stats.converged ? "converged" : "not converged"});
  table.add_row({"patches", std::to_string(stats.patches)});
  table.add_row({"elements", std::to_string(stats.elements)});
  table.add_row({"leaves", std::to_string(stats.leaves)});
  table.add_row({"links", std::to_string(stats.links)});
  table.add_row({"rays", std::to_string(stats.rays)});
  table.add_row({"iterations", std::to_string(stats.iterations) + " in " +
                                   std::to_string(stats.rounds) + " rounds"});
  table.add_row({"error estimate", stats.error_estimate < 0
                                       ? "not measured"
                                       : percent_text(stats.error_estimate) + " +- " +
                                             percent_text(stats.error_standard_error)});
  table.add_row({"area", short_text(stats.area, 6) + " " + report.unit + "^2, sealed " +
                             short_text(stats.sealed_area, 3)});
  table.add_row({"black backs met", percent_text(stats.back_share) + " of the rays"});
  table.add_row({"threads", std::to_string(stats.threads)});
  table.add_row({"peak memory", bytes_text(stats.memory_peak_bytes) + ", links " +
                                    bytes_text(stats.link_bytes) + ", nodes " +
                                    bytes_text(stats.node_bytes)});
  table.add_row({"state hash", report.hash});
  *text += table.text();
}

void append_balance(std::string* text, const SolveReport& report) {
  const size_t bands = report.emitted.size();
  TextTable table("l" + std::string(bands, 'r'));
  std::vector<std::string> head = {"power, W"};
  for (size_t band = 0; band < bands; ++band) head.push_back("band " + std::to_string(band));
  table.add_row(head);
  const auto add = [&](const char* name, const std::vector<double>& values) {
    std::vector<std::string> row = {name};
    for (double value : values) row.push_back(short_text(value, 6));
    table.add_row(row);
  };
  add("emitted", report.emitted);
  add("absorbed", report.absorbed);
  add("absorbed by backs", report.absorbed_back);
  add("escaped", report.escaped);
  std::vector<std::string> row = {"unaccounted"};
  for (size_t band = 0; band < bands; ++band) {
    const double emitted = report.emitted[band];
    const double left =
        emitted - report.absorbed[band] - report.absorbed_back[band] - report.escaped[band];
    row.push_back(emitted > 0 ? percent_text(left / emitted) : short_text(left, 3));
  }
  table.add_row(row);
  *text += "\n" + table.text();
}

void append_times(std::string* text, const SolveReport& report) {
  const hrad_stats& stats = report.stats;
  TextTable table("lr");
  table.add_row({"load", seconds_text(stats.seconds_load)});
  table.add_row({"initial stage", seconds_text(stats.seconds_initial)});
  table.add_row({"linking stage", seconds_text(stats.seconds_linking)});
  table.add_row({"iterative stage", seconds_text(stats.seconds_iterative)});
  table.add_row({"output", seconds_text(stats.seconds_output)});
  table.add_row({"processor time", seconds_text(stats.cpu_seconds)});
  *text += "\n" + table.text();
}

}  // namespace

std::string hash_text(const hrad_solver* solver) {
  uint64_t hash = 0;
  check(hrad_state_hash(solver, &hash));
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

SolveReport make_report(Session* session, const std::string& scene, int exit_code,
                        const std::vector<std::string>& files, double seconds_output) {
  SolveReport report;
  report.scene = scene;
  report.status = exit_code == exit_not_converged ? HRAD_NOT_CONVERGED : HRAD_OK;
  report.stats = session->stats();
  report.stats.seconds_output += seconds_output;
  const auto bands = static_cast<size_t>(session->bands());
  for (auto* values : {&report.emitted, &report.absorbed, &report.absorbed_back, &report.escaped})
    values->resize(bands);
  check(hrad_power_balance(session->solver(), report.emitted.data(), report.absorbed.data(),
                           report.absorbed_back.data(), report.escaped.data()));
  report.hash = hash_text(session->solver());
  report.unit = session->parameter("unit");
  report.diagnostics = session->diagnostics();
  report.files = files;
  return report;
}

void append_summary(std::string* text, const SolveReport& report) {
  append_counts(text, report);
  append_balance(text, report);
  append_times(text, report);
  if (report.files.empty()) return;
  *text += "\n";
  for (const std::string& file : report.files) *text += "wrote " + file + "\n";
}

void append_json(std::string* text, const SolveReport& report) {
  const hrad_stats& stats = report.stats;
  JsonWriter json(text);
  json.begin_object();
  json.field("version", hrad_version_text());
  json.field("scene", report.scene);
  json.field("status", hrad_status_name(report.status));
  json.field("converged", stats.converged != 0);
  json.field("rounds", stats.rounds);
  json.field("iterations", stats.iterations);
  json.field("patches", stats.patches);
  json.field("elements", stats.elements);
  json.field("leaves", stats.leaves);
  json.field("links", stats.links);
  json.field("swept_links", stats.swept_links);
  json.field("rays", stats.rays);
  json.field("pairs", stats.pairs);
  json.field("ranks", stats.ranks);
  json.field("threads", stats.threads);
  json.field("unit", report.unit);
  json.field("area", stats.area);
  json.field("sealed_area", stats.sealed_area);
  json.field("back_share", stats.back_share);
  const auto bands = static_cast<int64_t>(report.emitted.size());
  json.field("emitted", report.emitted.data(), bands);
  json.field("absorbed", report.absorbed.data(), bands);
  json.field("absorbed_back", report.absorbed_back.data(), bands);
  json.field("escaped", report.escaped.data(), bands);
  const bool measured = stats.error_estimate >= 0;
  json.field("error_estimate", measured ? stats.error_estimate : NAN);
  json.field("error_standard_error", measured ? stats.error_standard_error : NAN);
  json.field("state_hash", report.hash);
  json.begin_object("seconds");
  json.field("load", stats.seconds_load);
  json.field("initial", stats.seconds_initial);
  json.field("linking", stats.seconds_linking);
  json.field("iterative", stats.seconds_iterative);
  json.field("output", stats.seconds_output);
  json.end();
  json.field("cpu_seconds", stats.cpu_seconds);
  json.field("memory_peak_bytes", stats.memory_peak_bytes);
  json.field("link_bytes", stats.link_bytes);
  json.field("node_bytes", stats.node_bytes);
  json.begin_object("messages", JsonWriter::one_line);
  for (int kind = 0; kind < 3; ++kind) json.field(message_kinds[kind], stats.messages[kind]);
  json.end();
  json.begin_object("bytes", JsonWriter::one_line);
  for (int kind = 0; kind < 3; ++kind) json.field(message_kinds[kind], stats.message_bytes[kind]);
  json.end();
  json.begin_array("diagnostics");
  for (const std::string& diagnostic : report.diagnostics) json.value(diagnostic);
  json.end();
  json.begin_array("files");
  for (const std::string& file : report.files) json.value(file);
  json.end();
  json.end();
}

}  // namespace hrad::cli
