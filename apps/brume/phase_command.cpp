#include "phase_command.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "brume/brume.h"
#include "command_line.h"

namespace {

const char* const help_text =
    R"(Usage: brume phase                               list the phase functions and their parameters
       brume phase NAME [PARAMETER=VALUE...] [options]     show one of them

  --step DEGREES     between the rows of the table, a whole number from 1 to 90; default 10
  --plot             a plot instead of the table: angle to the right, logarithm upwards
  -o, --output FILE  a plot as .png, instead of the table

The angle is between the directions before and after scattering, 0 is straight on; mu is its
cosine. Values are per steradian, and their integral over all directions is 1.

  brume phase mie d=20 --plot
  brume phase two_lobe g1=0.9 w=0.8 -o two_lobe.png)";

struct Arguments {
  std::string name, output;
  brume::ParameterValues parameters;
  int step = 10;
  bool plot = false, help = false;
};

Arguments parse_arguments(const std::vector<std::string>& given) {
  Arguments a;
  std::string step;
  std::vector<std::string> settings;
  CommandLine line;
  line.option("NAME", a.name);
  line.options("PARAMETERS", settings);
  line.option("--step", step);
  line.option("-o,--output", a.output);
  line.flag("--plot", a.plot);
  line.flag("-h,--help", a.help);
  line.parse(given);
  if (a.help) return a;
  if (a.name.empty() && (a.plot || !step.empty() || !a.output.empty()))
    throw UsageError("brume phase needs the name of a phase function; without arguments it lists them");
  if (!step.empty()) a.step = static_cast<int>(parse_number("--step", step, 1, 90));
  for (const std::string& setting : settings) {
    const auto [name, value] = parse_setting("", setting);
    if (!a.parameters.emplace(name, value).second) throw UsageError("\"" + name + "\" is given twice");
  }
  return a;
}

void show_list() {
  for (const brume::PhaseInfo& phase : brume::phase_infos()) {
    std::printf("%s: %s\n", phase.name.c_str(), phase.meaning.c_str());
    show_parameters(phase.parameters, "    ");
  }
}

void show_heading(const brume::PhaseCurve& curve) {
  std::printf("%s\nmean cosine %.6g\n\n", curve.title.c_str(), curve.mean_cosine);
}

// Rows from 0 degrees on, and one for 180 in any case.
void show_table(const Arguments& a) {
  const brume::PhaseCurve curve = brume::phase_curve(a.name, a.parameters, 181);
  show_heading(curve);
  std::puts("  angle          mu     p (1/sr)");
  const auto row = [&](std::size_t i) {
    const double mu = std::cos(curve.angles[i] * std::numbers::pi / 180);
    std::printf("%7g  %10.6f  %11.6g\n", curve.angles[i], std::abs(mu) < 1e-9 ? 0 : mu, curve.values[i]);
  };
  for (std::size_t i = 0; i < 180; i += static_cast<std::size_t>(a.step)) row(i);
  row(180);
}

// 72 columns of 2.5 degrees and 20 lines; each column's mark is where its value is, and marks below one another join
// what a steep lobe would leave apart.
void show_plot(const Arguments& a) {
  constexpr int columns = 73, lines = 20;
  const brume::PhaseCurve curve = brume::phase_curve(a.name, a.parameters, columns);
  const brume::Decades range = brume::decades(curve);
  std::vector<std::string> rows(lines + 1, std::string(columns, ' '));
  const auto line_of = [&](int column) {
    const double exponent = std::log10(std::max(curve.values[static_cast<std::size_t>(column)], 1e-12));
    return static_cast<int>(std::lround(lines * (range.hi - exponent) / (range.hi - range.lo)));
  };
  for (int column = 0; column < columns; ++column) {
    const int at = line_of(column), next = line_of(std::min(column + 1, columns - 1));
    const int first = std::min(at, next > at ? at : next + 1), last = std::max(at, next > at ? next - 1 : at);
    for (int line = first; line <= last; ++line)
      rows[static_cast<std::size_t>(line)][static_cast<std::size_t>(column)] = '*';
  }
  show_heading(curve);
  for (int line = 0; line <= lines; ++line) {
    // A decade's label where its line is.
    const double decade = range.hi - static_cast<double>(line) * (range.hi - range.lo) / lines;
    const bool has_label = std::abs(decade - std::round(decade)) * lines < 0.5 * (range.hi - range.lo);
    char label[16] = "";
    if (has_label) std::snprintf(label, sizeof label, "1e%+d", static_cast<int>(std::lround(decade)));
    std::string& row = rows[static_cast<std::size_t>(line)];
    row.erase(row.find_last_not_of(' ') + 1);
    std::printf("%6s %c%s\n", label, has_label ? '+' : '|', row.c_str());
  }
  std::puts("       +-----------------+-----------------+-----------------+-----------------+");
  std::puts("       0                45                90               135               180 degrees");
}

}  // namespace

int phase_command(const std::vector<std::string>& arguments) {
  const Arguments a = parse_arguments(arguments);
  if (a.help) return std::puts(help_text), 0;
  if (a.name.empty()) return show_list(), 0;
  if (!a.output.empty()) brume::write_phase_plot(brume::phase_curve(a.name, a.parameters, 1441), a.output);
  if (a.plot) show_plot(a);
  if (!a.plot && a.output.empty()) show_table(a);
  return 0;
}
