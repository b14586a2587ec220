#pragma once

#include <filesystem>
#include <string_view>

namespace ghostlight {

/// A new version of a file, written beside it under another name until commit() puts it in place
/// in one step. Without commit() it is removed, and the old file is as it was. Links are followed
/// to the file they mean; the old file's permissions are kept. Throws Error.
class AsideFile {
   public:
    explicit AsideFile(const std::filesystem::path& file);
    ~AsideFile();
    AsideFile(const AsideFile&) = delete;
    AsideFile& operator=(const AsideFile&) = delete;

    /// Where to write: an empty file in the same folder. For a device it is the device itself.
    const std::filesystem::path& path() const { return aside_; }
    void write(std::string_view text);
    /// Waits until the data is on disk, then renames.
    void commit();

   private:
    [[noreturn]] void fail(const char* doing, int error_number) const;

    std::filesystem::path file_;    ///< as the caller named it
    std::filesystem::path target_;  ///< what it means, links followed
    std::filesystem::path aside_;
    bool pending_ = false;
};

}  // namespace ghostlight
