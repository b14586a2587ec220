#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/fit/photo.h"

namespace ghostlight {

/// A place in a photograph's file as a person sees it, upright: pixels from the upper left corner.
struct FilePoint {
    double x_px = 0.0, y_px = 0.0;
    bool operator==(const FilePoint&) const = default;
};

struct FileBox {
    double left_px = 0.0, top_px = 0.0, width_px = 0.0, height_px = 0.0;
    bool operator==(const FileBox&) const = default;
};

/// A painted part of a photograph that does not count: what its points enclose, or what a round
/// brush covers that is drawn along them.
struct MaskRegion {
    std::vector<FilePoint> points;
    double brush_px = 0.0;  ///< diameter; 0: the polygon
    bool operator==(const MaskRegion&) const = default;
};

/// "X,Y", pixels. Throws Error.
FilePoint parse_file_point(std::string_view text);
std::string text_of(const FilePoint& point);
/// "X,Y,WIDTH,HEIGHT", pixels. Throws Error.
FileBox parse_file_box(std::string_view text);
std::string text_of(const FileBox& box);
/// Regions separated by slashes: "X,Y,X,Y,X,Y" the corners of a polygon, "brush:D:X,Y,…" the way of
/// a brush D pixels wide. Nothing for an empty text. Throws Error.
std::vector<MaskRegion> parse_mask_regions(std::string_view text);
std::string text_of(const std::vector<MaskRegion>& regions);

/// Whether the region covers a point; a polygon that crosses itself by the even-odd rule.
bool covers(const MaskRegion& region, const FilePoint& point);

/// Masks the pixels whose middles the region covers.
void mask_region(Photo& photo, const MaskRegion& region);
/// Masks all pixels whose middles are outside of the box. Throws Error where that is all of them.
void mask_outside(Photo& photo, const FileBox& box);

}  // namespace ghostlight
