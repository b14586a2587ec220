#include "core/io/fit_photos.h"

#include <utility>

#include "core/io/photo_file.h"

namespace ghostlight {
namespace {

Photo read_adjusted(const FitPhotoSetup& setup, Notes& notes, const PhotoReader& read) {
    Photo photo = read(setup.file);
    notes.insert(notes.end(), photo.notes.begin(), photo.notes.end());
    adjust_photo(photo, setup);
    if (!setup.mask_file.empty()) mask_by_file(photo, setup.mask_file);
    return photo;
}

}  // namespace

FitPhoto read_fit_photo(const FitPhotoSetup& setup, const Prescription& lens, Notes& notes,
                        const PhotoReader& read) {
    return fit_photo(read_adjusted(setup, notes, read), setup, lens, notes);
}

std::vector<FitPhoto> read_fit_photos(const FitSetup& setup, const Prescription& lens, Notes& notes,
                                      const PhotoReader& read, std::stop_token stop) {
    std::vector<FitPhoto> photos;
    if (!setup.merge || setup.photos.size() < 2) {
        for (const FitPhotoSetup& each : setup.photos) {
            if (stop.stop_requested()) break;
            photos.push_back(read_fit_photo(each, lens, notes, read));
        }
        return photos;
    }
    std::vector<Photo> exposures;
    FitPhotoSetup all = setup.photos.front();
    for (const FitPhotoSetup& each : setup.photos) {
        if (stop.stop_requested()) return photos;
        exposures.push_back(read_adjusted(each, notes, read));
        if (exposures.size() > 1)
            all.masked.insert(all.masked.end(), each.masked.begin(), each.masked.end());
    }
    photos.push_back(fit_photo(merged(exposures), all, lens, notes));
    // What one of them leaves out is no matter of its exposure: it is left out of all.
    for (std::size_t k = 0; k < exposures.size(); ++k) {
        if (setup.photos[k].crop && k > 0)
            mask_outside(photos.front().photo, *setup.photos[k].crop);
        for (std::size_t i = 0; i < exposures[k].masked.size(); ++i)
            if (exposures[k].masked[i] == mask_reason::painted)
                photos.front().photo.masked[i] = mask_reason::painted;
    }
    return photos;
}

}  // namespace ghostlight
