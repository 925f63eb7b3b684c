#include "table.hpp"

#include <cstdio>

#include "verdict.hpp"

namespace {

template <class... Values>
std::string text(const char* format, Values... values) {
    char buffer[160];
    std::snprintf(buffer, sizeof buffer, format, values...);
    return buffer;
}

std::string status_text(const Outcome& outcome) {
    if (outcome.signal != 0) return text("signal %d", outcome.signal);
    return nm_status_name(outcome.status);
}

// Short enough for a column.
std::string seconds_text(double seconds) { return text(seconds < 0.01 ? "%.4f" : "%.2f", seconds); }

}  // namespace

const char* output_name(nm_output output) {
    return output == NM_OUTPUT_WELL_SPACED ? "well-spaced" : "hierarchical";
}

std::string table_head() {
    return "| case | dim | n | output | status | inputs kept | certificate | precision-limited | m/n | seconds | heap | resident | failure |\n"
           "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
}

std::string table_row(const Trial& trial, const Outcome& outcome, const Outcome& generic) {
    const bool meshed = outcome.status == NM_OK && outcome.vertices != 0;
    std::string row = "| " + trial.what.name + text(" | %u | %llu | ", trial.what.dim, static_cast<unsigned long long>(outcome.inputs));
    row += std::string(output_name(trial.output)) + " | " + status_text(outcome) + " | ";
    if (meshed) {
        row += outcome.inputs_kept == outcome.inputs ? "all" : text("%llu", static_cast<unsigned long long>(outcome.inputs_kept));
        row += outcome.violations == 0 ? text(" | %u, clean", outcome.certificate_level)
                                       : text(" | %u, %llu violations", outcome.certificate_level,
                                              static_cast<unsigned long long>(outcome.violations));
        row += text(" | %llu", static_cast<unsigned long long>(outcome.precision_limited));
        row += text(" | %.2f | ", static_cast<double>(outcome.vertices) / static_cast<double>(outcome.inputs));
    } else {
        row += "- | - | - | - | ";
    }
    row += seconds_text(outcome.seconds);
    const bool refused = trial.what.expected == Expected::non_finite || trial.what.expected == Expected::degenerate;
    row += refused ? " | - | -" : text(" | %.2f | %.2f", heap_ratio(trial, outcome, generic), resident_ratio(trial, outcome, generic));
    return row + " | " + failure(trial, outcome, generic) + " |\n";
}
