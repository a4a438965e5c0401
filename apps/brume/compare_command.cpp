#include "compare_command.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "brume/brume.h"
#include "command_line.h"

namespace {

const char* const help_text =
    R"(Usage: brume compare A B [REF] [options]     compare pictures (.exr, .pfm) of one scene

  --json     one JSON object instead of a table; null stands for what is not defined
  --block N  compare block means of N x N pixels (default 8); larger ones suit
             pictures with outliers

  mean ratio      the mean of A over that of B
  MSE             mean over pixels and channels of (A - B)^2 / 2
  relMSE          mean of (A - B)^2 / 2 / (ref^2 + 0.01); ref is REF, or else the mean of A
                  and B, averaged over the 3 x 3 pixels around each
  trimmed relMSE  the same without the 0.1 % of the pixels that have most of it
  z               (mean A - mean B) / standard error, for each block. Where both pictures
                  have the same expected values and their variances are right, the mean of
                  all z is within 4 / sqrt(n) of 0 and their standard deviation within
                  4 / sqrt(2 n) of 1. Both pictures need a layer Variance, as brume
                  --variance writes it, two seeds and the sampler "independent".

The errors are those of one of two renders with different seeds; where B has no noise, the
error of A is twice that. Pixels that are not finite in all pictures are left out.

  brume compare a.exr b.exr reference.exr)";

struct Arguments {
  std::string a, b, reference;
  int block_size = 8;
  bool json = false, help = false;
};

Arguments parse_arguments(const std::vector<std::string>& given) {
  Arguments a;
  std::string block;
  CommandLine line;
  line.flag("-h,--help", a.help);
  line.flag("--json", a.json);
  line.option("--block", block);
  line.option("A", a.a);
  line.option("B", a.b);
  line.option("REF", a.reference);
  line.parse(given);
  if (a.help) return a;
  if (!block.empty()) a.block_size = static_cast<int>(parse_number("--block", block, 1, 65536));
  if (a.b.empty()) throw UsageError("brume compare needs the names of two pictures");
  return a;
}

std::string text(double value, int digits) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.*g", digits, value);
  return buffer;
}

// A cell of the table.
std::string cell(double value) { return std::isfinite(value) ? text(value, 6) : "-"; }

using Channels = std::array<brume::Comparison::Channel, 3>;

// A line with one value for each channel.
template <class Value>
void show_channels(const char* name, const Channels& channels, Value&& value) {
  std::printf("%-15s", name);
  for (const brume::Comparison::Channel& channel : channels) std::printf(" %12s", cell(value(channel)).c_str());
}

void show_scores(const Channels& channels, int block_size) {
  if (!channels[0].scores) {
    std::puts("No z-scores: they need a layer Variance in both pictures.");
    return;
  }
  std::printf("\nz-scores of the means of blocks of %d x %d pixels\n", block_size, block_size);
  const auto line = [&](const char* name, auto&& value) {
    show_channels(name, channels, [&](const auto& channel) { return value(*channel.scores); });
    std::puts("");
  };
  line("blocks", [](const auto& s) { return static_cast<double>(s.blocks); });
  line("mean", [](const auto& s) { return s.mean; });
  line("  within 0 +-", [](const auto& s) { return s.mean_limit; });
  line("deviation", [](const auto& s) { return s.deviation; });
  line("  within 1 +-", [](const auto& s) { return s.deviation_limit; });
  line("unexplained", [](const auto& s) { return static_cast<double>(s.unexplained); });
  std::printf("%-15s", "");
  for (const auto& channel : channels) std::printf(" %12s", channel.scores->agree ? "agrees" : "DIFFERS");
  std::puts("");
}

void show_table(const Arguments& a, const brume::Comparison& c) {
  std::printf("A: %s\nB: %s\n", a.a.c_str(), a.b.c_str());
  if (!a.reference.empty()) std::printf("REF: %s\n", a.reference.c_str());
  std::printf("%d x %d pixels", c.width, c.height);
  if (c.invalid_pixels > 0)
    std::printf("; %lld that are not finite are left out", static_cast<long long>(c.invalid_pixels));
  std::printf("\n\n%-15s %12s %12s %12s %12s\n", "", "red", "green", "blue", "all");
  show_channels("mean A", c.channels, [](const auto& channel) { return channel.mean_a; });
  std::puts("");
  show_channels("mean B", c.channels, [](const auto& channel) { return channel.mean_b; });
  std::puts("");
  show_channels("mean ratio", c.channels, [](const auto& channel) { return channel.mean_ratio; });
  std::printf(" %12s\n", cell(c.mean_ratio).c_str());
  const auto overall = [](const char* name, double value) { std::printf("%-15s %51s\n", name, cell(value).c_str()); };
  overall("MSE", c.mse);
  overall("relMSE", c.relmse);
  overall("trimmed relMSE", c.trimmed_relmse);
  show_scores(c.channels, a.block_size);
}

// JSON has neither NaN nor infinity.
std::string number(double value) { return std::isfinite(value) ? text(value, 12) : "null"; }

std::string object(const std::vector<std::pair<std::string, std::string>>& members) {
  std::string list;
  for (const auto& [name, value] : members) list += (list.empty() ? "{\"" : ", \"") + name + "\": " + value;
  return list + "}";
}

std::string json(const brume::Comparison::Scores& s, int block_size) {
  return object({{"block_size", number(block_size)},
                 {"blocks", number(s.blocks)},
                 {"unexplained", number(s.unexplained)},
                 {"mean", number(s.mean)},
                 {"mean_limit", number(s.mean_limit)},
                 {"deviation", number(s.deviation)},
                 {"deviation_limit", number(s.deviation_limit)},
                 {"agree", s.agree ? "true" : "false"}});
}

std::string json(const brume::Comparison::Channel& c, int block_size) {
  return object({{"mean_a", number(c.mean_a)},
                 {"mean_b", number(c.mean_b)},
                 {"mean_ratio", number(c.mean_ratio)},
                 {"z", c.scores ? json(*c.scores, block_size) : "null"}});
}

std::string json(const brume::Comparison& c, int block_size) {
  return object({{"width", number(c.width)},
                 {"height", number(c.height)},
                 {"pixels", number(static_cast<double>(c.pixels))},
                 {"invalid_pixels", number(static_cast<double>(c.invalid_pixels))},
                 {"mean_ratio", number(c.mean_ratio)},
                 {"mse", number(c.mse)},
                 {"relmse", number(c.relmse)},
                 {"trimmed_relmse", number(c.trimmed_relmse)},
                 {"R", json(c.channels[0], block_size)},
                 {"G", json(c.channels[1], block_size)},
                 {"B", json(c.channels[2], block_size)}});
}

}  // namespace

int compare_command(const std::vector<std::string>& arguments) {
  const Arguments a = parse_arguments(arguments);
  if (a.help) return std::puts(help_text), 0;
  const brume::Comparison comparison = brume::compare(a.a, a.b, a.reference, a.block_size);
  if (a.json)
    std::puts(json(comparison, a.block_size).c_str());
  else
    show_table(a, comparison);
  return 0;
}
