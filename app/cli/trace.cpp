#include "core/optics/trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/output.h"
#include "app/cli/ray_list.h"
#include "app/cli/report.h"
#include "core/parallel.h"

namespace ghostlight::cli {
namespace {

struct TraceOptions {
    LensOptions lens;
    LightOptions light;
    std::string ghost, wavelength = "587.5618", rays;
    OutputOptions output;
};

std::vector<Cell> row_of(const TracedRay& ray, const glm::dvec2& entrance) {
    std::vector<Cell> row = {entrance.x, entrance.y, to_string(ray.status)};
    if (ray.status.reaches_sensor())
        row.insert(row.end(), {ray.sensor_point.x, ray.sensor_point.y, ray.direction.x,
                               ray.direction.y, ray.direction.z, ray.stop_point.x, ray.stop_point.y,
                               ray.r_rel, ray.weight, ray.weight_average});
    row.resize(13);
    return row;
}

void run(const TraceOptions& options) {
    const LightDirection light = light_direction(options.light);
    const double wavelength_nm = wavelength_value("--wavelength", options.wavelength);
    const LoadedLens loaded = load_lens(options.lens);
    const OpticalSystem system = compile(loaded.lens, wavelength_nm);
    const GhostPath path =
        read_option("--ghost", [&] { return parse_ghost(options.ghost, system); });
    const std::vector<glm::dvec2> rays = rays_from_csv(
        read_input(options.rays), options.rays == "-" ? "standard input" : options.rays);

    Report report;
    report.lens = lens_fields(loaded);
    report.request = {{"command", json_string("trace")},
                      {"ghost", json_string(name(path, system.surfaces.size()))},
                      {"wavelength_nm", json_value(wavelength_nm)},
                      {"field_deg", json_value(light.field_deg)},
                      {"azimuth_deg", json_value(light.azimuth_deg)}};
    report.heading = fmt::format("{}: {}, {} nm, field {} deg, azimuth {} deg",
                                 lens_heading(loaded), name(path, system.surfaces.size()),
                                 wavelength_nm, light.field_deg, light.azimuth_deg);
    report.table.columns = {
        "px_mm",     "py_mm",     "status", "x_mm",   "y_mm",          "dx", "dy", "dz",
        "stop_u_mm", "stop_v_mm", "r_rel",  "weight", "weight_average"};
    report.table.rows.resize(rays.size());
    constexpr std::size_t block = 256;  // rays a thread takes at a time
    parallel_for((rays.size() + block - 1) / block, 0, {}, [&](std::size_t index) {
        const std::size_t end = std::min(rays.size(), (index + 1) * block);
        for (std::size_t i = index * block; i < end; ++i)
            report.table.rows[i] = row_of(
                trace_ray(system, path, ray_at_entrance(light, rays[i].x, rays[i].y)), rays[i]);
    });
    write_report(report, options.output);
    print_notes(loaded.notes, Note::Severity::warning);
}

}  // namespace

void add_trace(CLI::App& program) {
    const auto options = std::make_shared<TraceOptions>();
    CLI::App* command = program.add_subcommand("trace", "follow rays along one ghost's path");
    add_lens(*command, options->lens)->required();
    add_text(*command, "--ghost", options->ghost, "i-j|direct",
             "the path: surfaces counted from 1, first reflection first")
        ->required();
    add_light(*command, options->light)->required();
    add_text(*command, "--wavelength", options->wavelength, "NM", "wavelength, nm")
        ->capture_default_str();
    add_text(*command, "--rays", options->rays, "FILE|-",
             "CSV with the header px_mm,py_mm: where each ray crosses the plane z = 0\n"
             "of the first vertex; - is standard input")
        ->required();
    add_output(*command, options->output);
    command->footer(R"(Examples:
  ghostlight-cli trace tessar_brendel_100_f2.8 --ghost 5-3 --wavelength 587.5618 --field 15 \
      --rays rays.csv --csv
  printf 'px_mm,py_mm\n0,0\n0,5\n' | ghostlight-cli trace tessar_brendel_100_f2.8 \
      --ghost direct --field 0 --rays -

Lengths in mm, angles in degrees. Status: ok, miss:K, tir:K, turned:K, clipped:K or stop:K with K
the surface's number.)");
    command->callback([options] { run(*options); });
}

}  // namespace ghostlight::cli
