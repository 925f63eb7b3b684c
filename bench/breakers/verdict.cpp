#include "verdict.hpp"

#include <algorithm>
#include <csignal>
#include <cstdio>

namespace {

double vertices_made(const Trial& trial, const Outcome& outcome) {
    return static_cast<double>(outcome.status == NM_LIMIT ? trial.max_vertices : outcome.vertices);
}

double ratio(const Trial& trial, const Outcome& outcome, const Outcome& generic, std::uint64_t Outcome::*bytes) {
    if (generic.*bytes == 0 || generic.vertices == 0) return 0.0;
    const double raw = static_cast<double>(outcome.*bytes) / static_cast<double>(generic.*bytes);
    const double growth = vertices_made(trial, outcome) / vertices_made(trial, generic);
    return raw / std::max(1.0, growth);
}

std::string refusal_failure(const Trial& trial, const Outcome& outcome, nm_status owed) {
    if (outcome.status != owed) {
        return std::string(nm_status_name(outcome.status)) + " instead of " + nm_status_name(owed);
    }
    if (std::string(outcome.message).find(trial.what.in_message) == std::string::npos) {
        return "the message does not say '" + trial.what.in_message + "'";
    }
    return "";
}

std::string mesh_failure(const Trial& trial, const Outcome& outcome) {
    if (outcome.status == NM_LIMIT
        && (trial.output == NM_OUTPUT_WELL_SPACED || trial.what.expected == Expected::mesh_or_range)) {
        return "";
    }
    if (outcome.status != NM_OK) {
        return std::string(nm_status_name(outcome.status)) + ": " + outcome.message;
    }
    if (outcome.inputs_kept != outcome.inputs) {
        return "loses " + std::to_string(outcome.inputs - outcome.inputs_kept) + " inputs";
    }
    if (outcome.violations != 0 || outcome.certificate_level != 3) return outcome.violation;
    if (trial.what.expected == Expected::mesh_without_limit && outcome.precision_limited != 0) {
        return "precision-limited where doubles suffice";
    }
    return "";
}

}  // namespace

double heap_ratio(const Trial& trial, const Outcome& outcome, const Outcome& generic) {
    return ratio(trial, outcome, generic, &Outcome::heap_bytes);
}

double resident_ratio(const Trial& trial, const Outcome& outcome, const Outcome& generic) {
    return ratio(trial, outcome, generic, &Outcome::resident_bytes);
}

std::string failure_of_itself(const Trial& trial, const Outcome& outcome) {
    const std::string place = std::string(" in ") + stage_name(outcome.stage);
    if (outcome.signal == SIGALRM) {
        return "no answer within " + std::to_string(trial.wall_limit) + " s" + place;
    }
    if (outcome.signal != 0) return "dies of signal " + std::to_string(outcome.signal) + place;
    if (outcome.exit_code != 0 || outcome.stage != Stage::done) {
        return "exits with " + std::to_string(outcome.exit_code) + place;
    }
    switch (trial.what.expected) {
        case Expected::non_finite: return refusal_failure(trial, outcome, NM_NON_FINITE);
        case Expected::degenerate: return refusal_failure(trial, outcome, NM_DEGENERATE_INPUT);
        default: return mesh_failure(trial, outcome);
    }
}

std::string failure(const Trial& trial, const Outcome& outcome, const Outcome& generic) {
    const std::string alone = failure_of_itself(trial, outcome);
    if (!alone.empty()) return alone;
    const double worst = std::max(heap_ratio(trial, outcome, generic), resident_ratio(trial, outcome, generic));
    if (worst > most_memory_ratio) {
        char text[64];
        std::snprintf(text, sizeof text, "takes %.1f times the memory", worst);
        return text;
    }
    return "";
}
