/* replay READER FOLDER: feeds every file of the folder to the reader, whole and cut off at each eighth of its length.
 * At least one must be accepted, or the corpus would not reach what it is for. */
#include "tests/fuzz/readers.h"
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool feed_file(const reader *r, const char *path)
{
    FILE *f = fopen(path, "rb");
    if (!f) abort();
    static uint8_t bytes[1 << 20];
    size_t size = fread(bytes, 1, sizeof bytes, f);
    fclose(f);
    for (size_t part = 0; part < 8; part++) reader_feed(r, bytes, size * part / 8);
    return reader_feed(r, bytes, size);
}

int main(int argc, char **argv)
{
    const reader *r = argc == 3 ? reader_find(argv[1]) : NULL;
    DIR *dir = argc == 3 ? opendir(argv[2]) : NULL;
    if (!r || !dir) {
        fprintf(stderr, "replay READER FOLDER\n");
        return 2;
    }
    reader_prepare();
    int count = 0, accepted = 0;
    for (struct dirent *d; (d = readdir(dir));) {
        char path[4096];
        if (*d->d_name == '.') continue;
        snprintf(path, sizeof path, "%s/%s", argv[2], d->d_name);
        accepted += feed_file(r, path);
        count++;
    }
    closedir(dir);
    printf("%s: %d files, each whole and in parts; %d accepted\n", r->name, count, accepted);
    return accepted ? 0 : 1;
}
