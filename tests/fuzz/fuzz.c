/* fuzz --reader=NAME [OPTION of libFuzzer...] CORPUS...: the bytes that libFuzzer makes, fed to one reader. */
#include "tests/fuzz/readers.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

static const reader *chosen;

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    for (int i = 1; i < *argc; i++)
        if (!strncmp((*argv)[i], "--reader=", 9)) chosen = reader_find((*argv)[i] + 9);
    if (!chosen) {
        fprintf(stderr, "which reader? --reader=");
        for (int i = 0; i < reader_count; i++) fprintf(stderr, "%s%s", i ? "|" : "", readers[i].name);
        fprintf(stderr, "\n");
        exit(2);
    }
    reader_prepare();
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    (void)reader_feed(chosen, bytes, size);
    return 0;
}
