/* Numbers in files do not depend on the process's locale: under one that writes 1,5 for one and a half,
 * files with points are read and written as ever, and a decimal comma is refused.
 *
 *   locale <directory for its files>
 *
 * Skipped where no such locale is installed (LOCPATH may name a directory with one).
 */
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "netmesh.h"
#include "support/require.h"

enum { skip_code = 77 };

/* Sets a locale with a decimal comma; answers 0 where there is none. */
static int set_comma_locale(void) {
    static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8", "nl_NL.UTF-8",
                                        "pl_PL.UTF-8", "ru_RU.UTF-8", "German_Germany.1252"};
    size_t i;
    for (i = 0; i < sizeof names / sizeof *names; ++i) {
        if (setlocale(LC_ALL, names[i]) != NULL && strcmp(localeconv()->decimal_point, ",") == 0) {
            printf("locale %s\n", names[i]);
            return 1;
        }
    }
    return 0;
}

static void write_text(const char *path, const char *text) {
    FILE *file = fopen(path, "wb");
    REQUIRE(file != NULL && fputs(text, file) >= 0 && fclose(file) == 0);
}

static nm_status read_text(const char *path, const char *text, nm_mesh **mesh) {
    nm_status status;
    write_text(path, text);
    status = nm_mesh_create_from_file(path, NM_FORMAT_AUTO, mesh);
    REQUIRE(remove(path) == 0);
    return status;
}

static void points_are_read(const char *directory) {
    static const char *const names[] = {"locale.xyz", "locale.csv", "locale.node", "locale.off"};
    static const char *const texts[] = {"0.5 0\n1.25e0 0\n0 1\n", "x,y\n0.5,0\n1.25e0,0\n0,1\n",
                                        "3 2\n0 0.5 0\n1 1.25e0 0\n2 0 1\n",
                                        "nOFF 2 3 0\n0.5 0\n1.25e0 0\n0 1\n"};
    static const double expected[] = {0.5, 0, 1.25, 0, 0, 1};
    size_t i;
    for (i = 0; i < sizeof names / sizeof *names; ++i) {
        char path[1024];
        double points[6];
        nm_mesh *mesh = NULL;
        snprintf(path, sizeof path, "%s/%s", directory, names[i]);
        REQUIRE(read_text(path, texts[i], &mesh) == NM_OK);
        REQUIRE(nm_mesh_get_points(mesh, points, 6, NULL) == NM_OK);
        REQUIRE(memcmp(points, expected, sizeof points) == 0);
        nm_mesh_free(mesh);
    }
}

static void decimal_commas_are_refused(const char *directory) {
    char path[1024];
    char message[256];
    nm_mesh *mesh = NULL;
    snprintf(path, sizeof path, "%s/locale_comma.xyz", directory);
    REQUIRE(read_text(path, "0,5 1,5\n1,5 0,5\n", &mesh) == NM_FORMAT_ERROR);
    REQUIRE(mesh == NULL);
    nm_last_error(message, sizeof message);
    REQUIRE(strstr(message, "line 1, column 3") != NULL);
}

typedef struct {
    char text[256];
    size_t size;
} written;

static int32_t append(const void *data, size_t size, void *user_data) {
    written *all = user_data;
    REQUIRE(all->size + size < sizeof all->text);
    memcpy(all->text + all->size, data, size);
    all->size += size;
    return 0;
}

/* Options too: a message shows numbers as this manual writes them. */
static void points_and_numbers_are_written(void) {
    const double points[] = {0.5, -1.25, 1e300, 2.5};
    written all = {{0}, 0};
    char message[256];
    nm_options options;
    nm_mesh *mesh = NULL;
    REQUIRE(nm_mesh_create(2, 2, points, 0, &mesh) == NM_OK);
    REQUIRE(nm_export_write(mesh, NM_FORMAT_XYZ, append, &all) == NM_OK);
    REQUIRE(strcmp(all.text, "0.5 -1.25\n1e300 2.5\n") == 0);
    REQUIRE(nm_options_init(&options, sizeof options) == NM_OK);
    options.epsilon = 7.5;
    REQUIRE(nm_run(mesh, &options) == NM_INVALID_ARGUMENT);
    nm_last_error(message, sizeof message);
    REQUIRE(strstr(message, "7.5") != NULL);
    nm_mesh_free(mesh);
}

int main(int count, char **arguments) {
    char half[16];
    if (count != 2) {
        fprintf(stderr, "usage: locale <directory>\n");
        return 2;
    }
    if (!set_comma_locale()) {
        puts("SKIP: no locale with a decimal comma is installed");
        return skip_code;
    }
    snprintf(half, sizeof half, "%.1f", 0.5);
    REQUIRE(strcmp(half, "0,5") == 0); /* the locale is in force */
    points_are_read(arguments[1]);
    decimal_commas_are_refused(arguments[1]);
    points_and_numbers_are_written();
    puts("locale: everything as expected");
    return 0;
}
