#include "core/flare/light_track.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ghostlight {
namespace {

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

/// How many frames a light may be unseen before another one may take its place.
constexpr std::size_t longest_gap = 48;

struct Following {
    LightTrack track;
    double x = 0.0, y = 0.0, vx = 0.0, vy = 0.0;
    std::size_t seen_last = 0;
    std::size_t sightings = 0;
};

}  // namespace

std::vector<LightBlob> find_blobs(const std::vector<float>& rgb, int width, int height,
                                  double threshold) {
    const std::size_t count = idx(width) * idx(height);
    std::vector<float> luminance(count);
    for (std::size_t i = 0; i < count; ++i)
        luminance[i] = 0.2126F * rgb[3 * i] + 0.7152F * rgb[3 * i + 1] + 0.0722F * rgb[3 * i + 2];
    const auto limit = static_cast<float>(threshold);
    std::vector<char> seen(count, 0);
    std::vector<LightBlob> blobs;
    std::vector<std::size_t> open;
    for (std::size_t start = 0; start < count; ++start) {
        if (seen[start] || !(luminance[start] > limit)) continue;
        LightBlob blob;
        double x = 0.0, y = 0.0, sum = 0.0;
        open.assign(1, start);
        seen[start] = 1;
        while (!open.empty()) {
            const std::size_t at = open.back();
            open.pop_back();
            ++blob.pixels;
            const int column = static_cast<int>(at % idx(width));
            const int row = static_cast<int>(at / idx(width));
            const double share = 1.0 - threshold / static_cast<double>(luminance[at]);
            for (std::size_t c = 0; c < 3; ++c)
                blob.excess[c] += share * std::max(0.0, static_cast<double>(rgb[3 * at + c]));
            const double weight = static_cast<double>(luminance[at]) - threshold;
            sum += weight;
            x += weight * (column + 0.5);
            y += weight * (row + 0.5);
            for (int j = std::max(0, row - 1); j <= std::min(height - 1, row + 1); ++j)
                for (int i = std::max(0, column - 1); i <= std::min(width - 1, column + 1); ++i) {
                    const std::size_t next = idx(j) * idx(width) + idx(i);
                    if (seen[next] || !(luminance[next] > limit)) continue;
                    seen[next] = 1;
                    open.push_back(next);
                }
        }
        blob.x_px = x / sum;
        blob.y_px = y / sum;
        blobs.push_back(blob);
    }
    std::ranges::stable_sort(blobs, std::ranges::greater{}, &LightBlob::luminance);
    return blobs;
}

double LightTrack::brightest() const {
    double most = 0.0;
    for (const LightBlob& blob : frames) most = std::max(most, blob.luminance());
    return most;
}

std::vector<LightTrack> track_lights(const std::vector<std::vector<LightBlob>>& frames,
                                     const TrackRequest& request) {
    std::vector<Following> lights;
    for (std::size_t f = 0; f < frames.size(); ++f) {
        std::vector<char> taken(frames[f].size(), 0);
        // A light seen just now has the first choice.
        std::ranges::stable_sort(lights, std::ranges::greater{}, &Following::seen_last);
        for (Following& light : lights) {
            const auto gap = static_cast<double>(f - light.seen_last);
            const double x = light.x + light.vx * gap, y = light.y + light.vy * gap;
            const double reach = request.farthest_px * std::sqrt(gap);
            std::size_t nearest = frames[f].size();
            double least = reach;
            for (std::size_t b = 0; b < frames[f].size(); ++b) {
                const double distance = std::hypot(frames[f][b].x_px - x, frames[f][b].y_px - y);
                if (!taken[b] && distance <= least) {
                    least = distance;
                    nearest = b;
                }
            }
            const bool is_lost = f - light.seen_last > longest_gap;
            if (nearest == frames[f].size() || is_lost) {
                LightBlob dark;
                dark.x_px = x;
                dark.y_px = y;
                light.track.frames.push_back(dark);
                continue;
            }
            taken[nearest] = 1;
            const LightBlob& blob = frames[f][nearest];
            if (light.sightings > 0) {
                light.vx = (blob.x_px - light.x) / gap;
                light.vy = (blob.y_px - light.y) / gap;
            }
            light.x = blob.x_px;
            light.y = blob.y_px;
            light.seen_last = f;
            ++light.sightings;
            light.track.frames.push_back(blob);
        }
        for (std::size_t b = 0; b < frames[f].size(); ++b) {
            if (taken[b]) continue;
            const LightBlob& blob = frames[f][b];
            Following light;
            LightBlob dark = blob;
            dark.excess = {};
            light.track.frames.assign(f, dark);
            light.track.frames.push_back(blob);
            light.x = blob.x_px;
            light.y = blob.y_px;
            light.seen_last = f;
            light.sightings = 1;
            lights.push_back(std::move(light));
        }
    }
    std::vector<LightTrack> tracks;
    double brightest = 0.0;
    for (const Following& light : lights) brightest = std::max(brightest, light.track.brightest());
    for (Following& light : lights)
        if (light.track.brightest() >= request.least_share * brightest && brightest > 0.0)
            tracks.push_back(std::move(light.track));
    std::ranges::stable_sort(tracks, std::ranges::greater{}, &LightTrack::brightest);
    if (tracks.size() > request.most) tracks.resize(request.most);
    return tracks;
}

}  // namespace ghostlight
