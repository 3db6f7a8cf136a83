# gnomon. Plain `make` needs a C compiler and make alone; `make help` lists the targets.
#
# What may be set: BUILD (folder of everything made), CC, CXX, HOST_ARCH (code of the simulator; empty: any machine),
# OIIO (yes: link OpenImageIO; default: where pkg-config finds it), LANES (yes: several cores in the simulator; default:
# where there is objcopy), LANE_CLANG (clang, for those that count operations; empty: without), V=1 (show commands).

BUILD ?= build
HOST_ARCH ?= -march=native
OIIO ?= $(shell pkg-config --exists OpenImageIO 2>/dev/null && command -v $(CXX) >/dev/null && echo yes)
LANES ?= $(shell command -v objcopy >/dev/null && echo yes)
LANE_CLANG ?= $(shell command -v clang)
LANES := $(LANES)
LANE_CLANG := $(LANE_CLANG)
WERROR ?=
V ?= 0

.DEFAULT_GOAL := all
.DELETE_ON_ERROR:
.SUFFIXES:
MAKEFLAGS += --no-builtin-rules
comma := ,
quiet := $(if $(filter 0,$(V)),@)
say = $(if $(filter 0,$(V)),@echo "  $(1)  $@")

# ---- what is compiled, and how -------------------------------------------------------------------------------------

CORE := $(wildcard core/*.c)
# Embedded targets. Partial redundancy elimination costs small triangles 3 %, and flash.
FAST := -O2 -fno-tree-pre
# No inner loops: compiled for size where flash counts; what these switches do for speed costs flash and gains nothing there.
SMALL := -Os -fno-schedule-insns2 -fno-move-loop-invariants -fno-code-hoisting
SETUP_SOURCES := $(patsubst %,core/gn_%.c,bias bins camera_pass clip fraction lambert matrix plan region scaled shading silhouette static_casters \
	transform trigonometry view volumes_spot wide)
HOST := $(wildcard host/*.c)
EMBEDDED_TARGETS :=
HOSTED_TARGETS :=
include $(wildcard port/*/*.mk)

WARNINGS := -Wall -Wextra -Wpedantic -Wshadow -Wundef -Wvla -Wwrite-strings -Wstrict-prototypes -Wmissing-prototypes
STRICT_WARNINGS := $(WARNINGS) -Wconversion -Wcast-qual -Wcast-align

# By the top folder of a source.
FLAGS_core := -std=c99 -ffreestanding $(STRICT_WARNINGS)
FLAGS_port := -std=c99 $(STRICT_WARNINGS) -Icore -Ihost -Iport -I$(BUILD)/golden
FLAGS_host := -std=c99 -D_XOPEN_SOURCE=700 -pthread $(WARNINGS) -Icore -Ihost
FLAGS_tests := $(FLAGS_host) -Itests -Wno-psabi

DEPTHS := 16 32

# Builds for this machine: the plain library, the simulator, and the one that looks for mistakes: assertions of the core,
# addresses, undefined behaviour.
library_FLAGS := -O2
host_FLAGS := -O3 $(HOST_ARCH) -DGN_STATISTICS=1 -DGN_COLOUR_CACHE=4096
host_TEST_FLAGS := -O2
checked_FLAGS := -O1 -g1 -DGN_CHECKED=1 -DGN_STATISTICS=1 -fsanitize=address,undefined -fno-sanitize-recover=all \
	-fno-omit-frame-pointer

# The simulator loads it from its own folder when a picture asks for it (host/oiio.h).
ifeq ($(OIIO),yes)
OIIO_BRIDGE := $(BUILD)/gnomon-oiio.so
OIIO_FLAGS = -std=c++17 -O2 -Wall -Wextra $(shell pkg-config --cflags OpenImageIO)
OIIO_LIBRARIES = $(shell pkg-config --libs OpenImageIO)
endif

# ---- objects -------------------------------------------------------------------------------------------------------

# Everything is compiled anew when a flag changes.
ALL_FLAGS = $(CC) $(CFLAGS) $(FLAGS_core) $(FLAGS_host) $(host_FLAGS) $(SETUP_SOURCES) $(SMALL) $(FAST) \
	$(LANES) $(LANE_CLANG)
$(BUILD)/flags: always
	@mkdir -p $(@D)
	@echo '$(ALL_FLAGS)' | cmp -s - $@ || echo '$(ALL_FLAGS)' >$@

# $(call compile,FOLDER,COMPILER,FLAGS,SETUP_FLAGS,TEST_FLAGS): build/objects/FOLDER/core/x.o from core/x.c, and so on.
define compile
$(BUILD)/objects/$(1)/%.o: %.c $(BUILD)/flags
	$$(call say,$(1))
	@mkdir -p $$(@D)
	$(quiet)$(2) $$(FLAGS_$$(firstword $$(subst /, ,$$<))) $(3) $$(if $$(filter $$<,$$(SETUP_SOURCES)),$(4)) \
		$$(if $$(filter tests/%,$$<),$(5)) $(WERROR) $(CFLAGS) -MMD -MP -c $$< -o $$@
endef

# $(call objects,FOLDER,SOURCES)
objects = $(patsubst %.c,$(BUILD)/objects/$(1)/%.o,$(2))

define archive
	$(call say,archive)
	@mkdir -p $(@D)
	@rm -f $@
	$(quiet)$(1)ar rcs $@ $^
endef

# Names of objects alone: linked where they lie.
define thin_archive
	@mkdir -p $(@D)
	@rm -f $@
	$(quiet)ar rcsT $@ $^
endef

HOST_BUILDS := library host checked
$(foreach b,$(HOST_BUILDS),$(foreach d,$(DEPTHS),\
	$(eval $(call compile,$(b)-$(d),$(CC),$($(b)_FLAGS) -DGN_DEPTH_BITS=$(d),,$($(b)_TEST_FLAGS)))))

$(BUILD)/gnomon-oiio.so: host/oiio.cpp host/oiio.h host/image.h $(BUILD)/flags
	$(call say,oiio)
	@mkdir -p $(@D)
	$(quiet)$(CXX) $(OIIO_FLAGS) $(WERROR) -fPIC -shared $< $(OIIO_LIBRARIES) -o $@

-include $(shell find $(BUILD)/objects -name '*.d' 2>/dev/null)

# ---- the library and the simulator ---------------------------------------------------------------------------------

all: $(BUILD)/libgnomon.a $(BUILD)/libgnomon32.a $(BUILD)/gnomon $(BUILD)/gnomon32 $(OIIO_BRIDGE) ## build the library and the simulator for 16 and 32 bits of depth (the default)

$(BUILD)/libgnomon.a: $(call objects,library-16,$(CORE))
	$(archive)
$(BUILD)/libgnomon32.a: $(call objects,library-32,$(CORE))
	$(archive)

# Lanes (host/lane.h): a core and what depends on it of the simulator in one object, which shows nothing but the lane.
LANE_HOST := $(patsubst %,host/%.c,choices lane method render_options settings_report)

# $(call show_lane_alone,SYMBOL)
show_lane_alone = { $(CC) -nostdlib -r $$^ -o $$@.all && \
	objcopy --redefine-sym lane_here=$(1) --keep-global-symbol=$(1) $$@.all $$@ && rm $$@.all; }

# $(call lane,FILE,SYMBOL,OBJECTS)
define lane
$(BUILD)/lanes/$(1).o: $(3)
	$$(call say,lane)
	@mkdir -p $$(@D)
	$(quiet)$(call show_lane_alone,$(2))
endef
$(foreach b,host checked,$(foreach d,$(DEPTHS),\
	$(eval $(call lane,$(b)-$(d),lane_$(d),$(call objects,$(b)-$(d),$(LANE_HOST) $(CORE))))))
# Plans as a firmware makes them: the plain library.
$(foreach d,$(DEPTHS),$(eval $(call lane,firmware-$(d),lane_$(d)_firmware,\
	$(call objects,host-$(d),$(LANE_HOST)) $(call objects,library-$(d),$(CORE)))))

# Cores that count operations: plain code of 32 bits, each basic block of which calls lane_count. Where that cannot be
# made, the lane is an empty object, and the build says why.
LANE_COUNTED := -std=c99 -ffreestanding -w -fPIE -O1 -fno-unroll-loops -fno-vectorize -fno-slp-vectorize \
	-DGN_WIDE_DIVIDE=0 -include host/lane_counter.h -S -emit-llvm
define counted_core
$(BUILD)/objects/counted-$(1)/core/%.o: core/%.c host/lane_counter.h host/count_operations.awk $(BUILD)/flags
	$$(call say,counted-$(1))
	@mkdir -p $$(@D)
	$(quiet){ $(LANE_CLANG) $(LANE_COUNTED) -DGN_DEPTH_BITS=$(1) \
			-MMD -MP -MT $$@ -MF $$(@:.o=.d) $$< -o $$(@:.o=.ll) && \
		awk -f host/count_operations.awk $$(@:.o=.ll) >$$(@:.o=.counted.ll) && \
		$(LANE_CLANG) -w -fPIE -O1 -c $$(@:.o=.counted.ll) -o $$@; } 2>$$(@:.o=.problem) && \
		rm $$(@:.o=.problem) || { echo "$$<: not made" >>$$(@:.o=.problem); : >$$@; }
endef
define counted_lane
$(BUILD)/lanes/counted-$(1).o: $(call objects,host-$(1),$(filter-out host/lane.c,$(LANE_HOST))) \
		$(call objects,counted-$(1),host/lane.c $(CORE))
	$$(call say,lane)
	@mkdir -p $$(@D)
	$(quiet)cat $(patsubst %.o,%.problem,$(call objects,counted-$(1),$(CORE))) >$$@.problem 2>/dev/null; \
	{ ! [ -s $$@.problem ] && $(call show_lane_alone,lane_$(1)_counted) 2>$$@.problem; } || \
		{ echo "  no lane that counts operations: $$$$(head -n 1 $$@.problem)"; $(CC) -x c -c /dev/null -o $$@; }
endef
$(foreach d,$(if $(LANE_CLANG),$(DEPTHS)),\
	$(eval $(call compile,counted-$(d),$(CC),$(host_FLAGS) -DGN_DEPTH_BITS=$(d) -DLANE_COUNTS=1)) \
	$(eval $(call counted_core,$(d))) $(eval $(call counted_lane,$(d))))

# $(call lanes,BUILD-DEPTH): those beside the program's own.
lanes = $(if $(filter yes,$(LANES)),$(patsubst %,$(BUILD)/lanes/%.o,\
	$(if $(filter %-16,$(1)),$(1:16=32),$(1:32=16)) $(DEPTHS:%=firmware-%) $(if $(LANE_CLANG),$(DEPTHS:%=counted-%))))

# $(call simulator,PROGRAM,BUILD-DEPTH,BUILD): its run path, where it looks for the bridge, is its own folder.
define simulator
$(1): $(call objects,$(2),$(HOST) $(CORE)) $(call lanes,$(2))
	$$(call say,link)
	@mkdir -p $$(@D)
	$(quiet)$(CC) $($(3)_FLAGS) -pthread $$^ -lm -ldl '-Wl,-rpath,$$$$ORIGIN' -o $$@
endef
$(eval $(call simulator,$(BUILD)/gnomon,host-16,host))
$(eval $(call simulator,$(BUILD)/gnomon32,host-32,host))
$(foreach d,$(DEPTHS),$(eval $(call simulator,$(BUILD)/checked-$(d)/gnomon,checked-$(d),checked)))

demo: ## install OpenImageIO if it is missing, render the built-in scenes, name the pictures
	$(quiet)tests/setup.sh demo
	$(quiet)$(MAKE) --no-print-directory -j$$(nproc) all
	$(quiet)$(MAKE) --no-print-directory demo-pictures

demo-pictures: $(BUILD)/gnomon $(OIIO_BRIDGE)
	@mkdir -p $(BUILD)/demo
	$(quiet)$< procedural all -o $(BUILD)/demo
	$(quiet)for scene in $(BUILD)/demo/*.scene; do $< render $$scene -o $${scene%.scene}.png || exit 1; done
	@echo "The pictures:"
	@ls $(BUILD)/demo/*.png

# ---- targets: libraries and programs of port/ ----------------------------------------------------------------------

PROGRAM := port/print.c
GOLDEN_SCENES := lshape torus2 table pipes pins fence
GOLDEN_HEADERS := $(GOLDEN_SCENES:%=$(BUILD)/golden/%.h)
CALIBRATION_SCENES := $(GOLDEN_SCENES) castle colonnade crowd factory room sheets
CALIBRATION_HEADERS := $(CALIBRATION_SCENES:%=$(BUILD)/golden/%.h)
VALIDATION_SCENES := $(addsuffix _view21,castle factory fence pins room table)
VALIDATION_HEADERS := $(VALIDATION_SCENES:%=$(BUILD)/golden/%.h)
# The simulator's own build and the one that looks for mistakes take part as well.
TARGETS := $(EMBEDDED_TARGETS) $(HOSTED_TARGETS) host checked
TARGET_DEPTHS := $(foreach d,$(DEPTHS),$(addsuffix -$(d),$(TARGETS)))
# The simulator's build trades memory for speed: more than the smallest program has.
MINIMAL_DEPTHS := $(filter-out host-%,$(TARGET_DEPTHS))
EMBEDDED_DEPTHS := $(foreach d,$(DEPTHS),$(addsuffix -$(d),$(EMBEDDED_TARGETS)))

# Scenes are packed once, on this machine, with edges for shadow volumes, and compiled for all targets. A header that
# comes out equal keeps its date.
$(BUILD)/golden/%.h: $(BUILD)/gnomon
	$(call say,pack)
	@mkdir -p $(@D)/new
	$(quiet)$< procedural $* -o $(@D) && $< pack $(@D)/$*.scene --edges -o $(@D)/new/$(@F) >/dev/null
	@cmp -s $(@D)/new/$(@F) $@ || cp $(@D)/new/$(@F) $@

$(BUILD)/golden/%_view21.h: $(BUILD)/gnomon
	$(call say,pack)
	@mkdir -p $(@D)
	$(quiet)$< procedural $* --view 21 -o $(@D) && $< pack $(@D)/$*_view21.scene --edges -o $@ >/dev/null

$(BUILD)/golden/footprint.h: $(BUILD)/gnomon port/footprint/scene.awk
	$(call say,pack)
	@mkdir -p $(@D)
	$(quiet)awk -v folder=$(@D) -f port/footprint/scene.awk && $< pack $(@D)/footprint.scene --edges -o $@ >/dev/null

# -fcallgraph-info: what a function needs of the stack, and what it calls.
$(foreach t,$(EMBEDDED_TARGETS),$(foreach d,$(DEPTHS),\
	$(eval $(call compile,$(t)-$(d),$($(t)_TOOL)gcc,$(FAST) -ffreestanding $($(t)_FLAGS) -DGN_DEPTH_BITS=$(d) \
		-ffunction-sections -fdata-sections -fcallgraph-info=su,$(SMALL)))))
$(foreach t,$(HOSTED_TARGETS),$(foreach d,$(DEPTHS),\
	$(eval $(call compile,$(t)-$(d),$($(t)_CC),$($(t)_FLAGS) -DGN_DEPTH_BITS=$(d)))))

LINKER_SCRIPTS := $(wildcard port/*/*.ld)

# $(call embedded_rules,TARGET,TARGET-DEPTH)
define embedded_rules
$(BUILD)/$(2)/libgnomon.a: $(call objects,$(2),$(CORE))
	$$(call archive,$($(1)_TOOL))
$(BUILD)/$(2)/%.elf: $(BUILD)/objects/$(2)/port/%.o $(call objects,$(2),$(PROGRAM) $($(1)_PORT)) $(BUILD)/$(2)/libgnomon.a \
		$(LINKER_SCRIPTS)
	$$(call say,link)
	@mkdir -p $$(@D)
	$(quiet)$($(1)_TOOL)gcc $($(1)_FLAGS) $$($(1)_LINK) $$(filter %.o,$$^) $$(filter %.a,$$^) -lgcc -o $$@
$(BUILD)/objects/$(2)/port/firmware.o $(BUILD)/objects/$(2)/port/bench/bench.o: $(GOLDEN_HEADERS)
$(BUILD)/$(2)/firmware.elf: $(BUILD)/objects/$(2)/port/methods.o
$(BUILD)/$(2)/bench/bench.elf: $(patsubst %,$(BUILD)/objects/$(2)/port/bench/%.o,casters edges warps)
$(BUILD)/objects/$(2)/port/report/report.o $(BUILD)/objects/$(2)/port/report/check.o: $(GOLDEN_HEADERS)
$(BUILD)/objects/$(2)/port/report/calibrate.o: $(CALIBRATION_HEADERS)
$(BUILD)/objects/$(2)/port/report/validate.o: $(VALIDATION_HEADERS)
$(foreach p,report check calibrate validate,$(BUILD)/$(2)/report/$(p).elf): $(BUILD)/objects/$(2)/port/report/chains.o
$(BUILD)/hashes/$(2).txt: $(BUILD)/$(2)/firmware.elf
	$$(call run_firmware,$$($(1)_RUN) -kernel)
$(BUILD)/$(2)/minimal_main.txt: $(BUILD)/$(2)/minimal_main.elf
	$$(call run_firmware,$$($(1)_RUN) -kernel)
endef
$(foreach t,$(EMBEDDED_TARGETS),$(foreach d,$(DEPTHS),$(eval $(call embedded_rules,$(t),$(t)-$(d)))))

# $(call hosted_rules,TARGET,TARGET-DEPTH)
define hosted_rules
$(BUILD)/$(2)/%.elf: $(call objects,$(2),port/%.c $(PROGRAM) port/linux/console.c $(CORE))
	$$(call say,link)
	@mkdir -p $$(@D)
	$(quiet)$(or $($(1)_CC),$(CC)) $($(1)_FLAGS) $$^ $($(1)_LINK) -o $$@
$(BUILD)/$(2)/firmware.elf: $(BUILD)/objects/$(2)/port/methods.o
$(BUILD)/objects/$(2)/port/firmware.o: $(GOLDEN_HEADERS)
$(foreach p,report check calibrate,$(BUILD)/$(2)/report/$(p).elf): $(BUILD)/objects/$(2)/port/report/chains.o
$(BUILD)/objects/$(2)/port/report/report.o $(BUILD)/objects/$(2)/port/report/check.o: $(GOLDEN_HEADERS)
$(BUILD)/objects/$(2)/port/report/calibrate.o: $(CALIBRATION_HEADERS)
$(BUILD)/hashes/$(2).txt: $(BUILD)/$(2)/firmware.elf
	$$(call run_firmware,$$($(1)_RUN))
$(BUILD)/$(2)/minimal_main.txt: $(BUILD)/$(2)/minimal_main.elf
	$$(call run_firmware,$$($(1)_RUN))
endef
$(foreach t,$(filter-out $(EMBEDDED_TARGETS),$(TARGETS)),$(foreach d,$(DEPTHS),$(eval $(call hosted_rules,$(t),$(t)-$(d)))))

# $(call run_firmware,COMMAND): what the firmware printed, also when it failed.
define run_firmware
	$(call say,run)
	@mkdir -p $(@D)
	$(quiet)$(1) $< </dev/null >$@ || { echo "error exit status $$?" >>$@; tail -n 2 $@; }
endef

.SECONDARY:

hashes: $(TARGET_DEPTHS:%=$(BUILD)/hashes/%.txt) ## render the golden scenes on every target; fail where two hashes differ
	$(quiet)awk -f tests/golden/compare.awk tests/golden/hashes.txt $^

accept-hashes: $(BUILD)/hashes/gcc-O0-16.txt $(BUILD)/hashes/gcc-O0-32.txt ## make today's hashes the golden ones (with a new GN_BITS_VERSION)
	$(quiet)awk -f tests/golden/accept.awk $^ >$(BUILD)/hashes.new && mv $(BUILD)/hashes.new tests/golden/hashes.txt

# ---- figures: instructions, bytes ----------------------------------------------------------------------------------

BENCH_TARGETS := cortex-m4 cortex-m0 rv32imc
BENCH_COUNTS := $(BENCH_TARGETS:%=$(BUILD)/bench/%.count)
QEMU_MAJOR = $(shell qemu-system-arm --version | sed -n 's/.*version \([0-9]*\).*/\1/p')

$(BUILD)/bench/count_plugin.so: port/bench/count_plugin.c
	$(call say,plugin)
	@mkdir -p $(@D)
	$(quiet)$(CC) -std=gnu11 -O2 $(WARNINGS) -fPIC -shared -DPLUGIN_API=$$(($(QEMU_MAJOR) >= 9 ? 2 : 1)) $< -o $@

# $(call count,PLUGIN OPTIONS): what the program printed, then what the plugin counted. A clock that follows the
# instructions would only take time: nothing reads it between the marks.
define count
	$(call say,count)
	@mkdir -p $(@D)
	$(quiet)address() { echo 0x$$($($*_TOOL)nm $< | awk -v name=$$1 '$$3 == name { print $$1 }'); }; \
	$(patsubst 900,3600,$(filter-out -icount shift=%,$($*_RUN))) -kernel $< \
		-plugin $(BUILD)/bench/count_plugin.so,begin=$$(address mark_begin),end=$$(address mark_end)$(1) \
		</dev/null >$@ 2>$@.regions || { echo "error exit status $$?"; tail -n 2 $@ $@.regions; }
	@cat $@.regions >>$@
endef

$(BUILD)/bench/%.count: $(BUILD)/%-16/bench/bench.elf $(BUILD)/bench/count_plugin.so
	$(call count)
$(BUILD)/bench/%.profile: $(BUILD)/%-16/bench/bench.elf $(BUILD)/bench/count_plugin.so
	$(call count,$(comma)functions=on)

bench-targets: $(BENCH_COUNTS) ## count instructions on Cortex-M4, Cortex-M0 and rv32imc; fail where the M4 exceeds a limit
	$(quiet)awk -f port/bench/table.awk $^

profile: $(BENCH_TARGETS:%=$(BUILD)/bench/%.profile) ## say what each function took of each case of bench-targets
	@awk 'FNR == 1 { n = 0 } $$1 == "case" { name[n++] = $$2 } $$1 == "region" { print FILENAME, name[$$2], $$4 } \
		$$1 == "function" && $$2 > 100 { printf "%12d %s\n", $$2, $$3 }' $^

# The frames of docs/report, those of its test, and those that the cost model is fitted to.
REPORT_TARGETS := cortex-m4 cortex-m0 rv32imc rv32i
$(BUILD)/report/%.count: $(BUILD)/%-16/report/report.elf $(BUILD)/bench/count_plugin.so
	$(call count)
$(BUILD)/report-check/%.count: $(BUILD)/%-16/report/check.elf $(BUILD)/bench/count_plugin.so
	$(call count)
$(BUILD)/calibrate/%.count: $(BUILD)/%-16/report/calibrate.elf $(BUILD)/bench/count_plugin.so
	$(call count)
$(BUILD)/validate/%.count: $(BUILD)/%-16/report/validate.elf $(BUILD)/bench/count_plugin.so
	$(call count)
$(BUILD)/report/%.flash: $(BUILD)/objects/%-16/port/report/linked.o $(BUILD)/objects/%-16/port/memory.o $(BUILD)/%-16/libgnomon.a \
		port/report/chains.c port/report/flash.sh
	$(call say,flash)
	@mkdir -p $(@D)
	$(quiet)sed -n 's/.*{\.name = "\([^"]*\)".*/\1/p' port/report/chains.c | \
		port/report/flash.sh $(BUILD) $*-16 $($*_TOOL) $($*_FLAGS) >$@
$(BUILD)/report/%.version: always
	@mkdir -p $(@D)
	@$($*_TOOL)gcc --version | sed -n 1p | cmp -s - $@ || $($*_TOOL)gcc --version | sed -n 1p >$@

# Two of them are counted anew by the tests, in part.
REPORT_CHECKED := cortex-m4 rv32imc
REPORT_INPUTS := $(BUILD)/report/targets $(foreach t,$(REPORT_CHECKED),$(BUILD)/report-check/$(t).count \
	$(BUILD)/report/$(t).flash $(BUILD)/report/$(t).version)
REPORT_FILES := $(foreach t,$(REPORT_TARGETS),$(addprefix $(BUILD)/report/$(t).,count flash version))
report: $(BUILD)/report/targets $(OIIO_BRIDGE) $(REPORT_FILES) ## errors, instructions and bytes of every chain on four targets: docs/report
	@mkdir -p docs/report
	$(quiet)$< $(BUILD)/report $(BUILD)/report $(GOLDEN_SCENES:%=$(BUILD)/golden/%.scene) \
		--csv docs/report/targets.csv --page docs/report/index.html
	$(quiet)awk -f tests/report/targets_table.awk docs/report/targets.csv >$(BUILD)/report/README.md
	$(quiet)mv $(BUILD)/report/README.md docs/report/README.md

# Programs of tests/report that link the simulator with all its lanes; pictures as the simulator makes them.
$(BUILD)/report/%: $(BUILD)/objects/host-16/tests/report/%.o $(BUILD)/objects/host-16/port/report/chains.o \
		$(call objects,host-16,$(filter-out host/main.c,$(HOST)) $(CORE)) $(call lanes,host-16)
	$(call say,link)
	@mkdir -p $(@D)
	$(quiet)$(CC) $(host_FLAGS) -pthread $^ -lm -ldl '-Wl,-rpath,$$ORIGIN/..' -o $@

COST_COUNTS := $(BUILD)/calibrate/cortex-m4.count $(CALIBRATION_SCENES:%=$(BUILD)/golden/%.scene)
COST_UNSEEN := $(BUILD)/validate/cortex-m4.count $(VALIDATION_SCENES:%=$(BUILD)/golden/%.scene)
COST_GROUPS := castle,colonnade crowd,factory fence,lshape pins,pipes room,sheets table,torus2
cost-model: $(BUILD)/report/cost_fit $(BUILD)/calibrate/cortex-m4.count ## fit the cost model anew: host/cost_model_table.c
	$(quiet)$< $(COST_COUNTS) >$(BUILD)/cost_model_table.c && mv $(BUILD)/cost_model_table.c host/cost_model_table.c

COST_INPUTS := $(BUILD)/report/cost_fit $(BUILD)/calibrate/cortex-m4.count $(BUILD)/validate/cortex-m4.count
cost-model-errors: $(COST_INPUTS) ## say how well the cost model predicts scenes that it was not fitted to
	$(quiet)$< $(COST_COUNTS) --validate $(COST_GROUPS)
	$(quiet)$< $(COST_UNSEEN) --check

# One job by a map, by shadow volumes, and with each way to test a pixel.
FOOTPRINTS := $(basename $(notdir $(wildcard port/footprint/*.c)))
$(FOOTPRINTS:%=$(BUILD)/objects/cortex-m4-16/port/footprint/%.o): $(BUILD)/golden/footprint.h
$(BUILD)/cortex-m4-16/footprint/%.elf: cortex-m4_LINK = $(call arm_link,port/footprint/board.ld)
$(BUILD)/cortex-m4-16/footprint/%.txt: $(BUILD)/cortex-m4-16/footprint/%.elf
	$(call run_firmware,$(cortex-m4_RUN) -kernel)

sizes: $(EMBEDDED_DEPTHS:%=$(BUILD)/%/libgnomon.a) $(FOOTPRINTS:%=$(BUILD)/cortex-m4-16/footprint/%.txt) ## flash, RAM and stack of the core by target
	$(quiet)port/footprint/sizes.sh $(BUILD) $(EMBEDDED_DEPTHS)

# ---- tests ---------------------------------------------------------------------------------------------------------

CORE_TESTS := $(wildcard tests/core/*.c)
HOST_TESTS := $(wildcard tests/host/*.c)
# One program of many files. Slower builds run a shorter list of its cases.
HARD := $(wildcard tests/hard/*.c)
HARD_BUILDS := host-16 host-32 checked-16
# tests/report: tables for docs/, made by hand with the peers.
SHELL_TESTS := $(filter-out tests/report/%,$(wildcard tests/*/*.sh))
# What names neither depths nor plans comes out the same for 32 bits.
DEPTH_TESTS := $(shell grep -lE '\<(GN_DEPTH_BITS|gn_depth|gn_plan|gn_init)\>' $(CORE_TESTS) $(HOST_TESTS))
TEST_PROGRAMS := $(foreach b,host checked,$(patsubst %.c,$(BUILD)/$(b)-16/%,$(CORE_TESTS) $(HOST_TESTS)) \
	$(DEPTH_TESTS:%.c=$(BUILD)/$(b)-32/%)) $(HARD_BUILDS:%=$(BUILD)/%/tests/hard/hard)

# $(call test_rules,BUILD-DEPTH,BUILD): tests of the simulator link what they need of all of it but its main.
define test_rules
$(BUILD)/$(1)/core.a: $(call objects,$(1),$(CORE))
	$$(thin_archive)
$(BUILD)/$(1)/host.a: $(call objects,$(1),$(filter-out host/main.c,$(HOST)))
	$$(thin_archive)
$(BUILD)/$(1)/tests/core/%: $(BUILD)/objects/$(1)/tests/core/%.o $(BUILD)/$(1)/core.a
	$$(call link_test,$(2))
$(BUILD)/$(1)/tests/host/%: $(BUILD)/objects/$(1)/tests/host/%.o $(BUILD)/$(1)/host.a $(BUILD)/$(1)/core.a
	$$(call link_test,$(2))
$(BUILD)/$(1)/tests/hard/hard: $(call objects,$(1),$(HARD)) $(BUILD)/$(1)/host.a $(BUILD)/$(1)/core.a
	$$(call link_test,$(2))
endef
define link_test
	$(call say,link)
	@mkdir -p $(@D)
	$(quiet)$(CC) $($(1)_FLAGS) -pthread $(filter %.o,$^) $(filter %.a,$^) -lm -ldl -o $@
endef
$(foreach b,host checked,$(foreach d,$(DEPTHS),$(eval $(call test_rules,$(b)-$(d),$(b)))))
# Other tests do without lanes: host/lanes.c then finds none.
$(foreach b,host checked,$(foreach d,$(DEPTHS),\
	$(eval $(BUILD)/$(b)-$(d)/tests/host/lane_test: $(call lanes,$(b)-$(d)))))

# First what runs for long when it is built.
TEST_INPUTS := $(TARGET_DEPTHS:%=$(BUILD)/hashes/%.txt) $(BENCH_COUNTS) $(MINIMAL_DEPTHS:%=$(BUILD)/%/minimal_main.txt) \
	$(EMBEDDED_DEPTHS:%=$(BUILD)/%/libgnomon.a) $(FOOTPRINTS:%=$(BUILD)/cortex-m4-16/footprint/%.txt) \
	$(REPORT_INPUTS) all $(TEST_PROGRAMS) $(BUILD)/checked-16/gnomon

test: ## install what is missing, build for host and targets, run everything, count what passed and failed
	$(quiet)tests/setup.sh test
	$(quiet)$(MAKE) --no-print-directory -j$$(nproc) WERROR=-Werror test-inputs || { echo "0 passed, 1 failed"; exit 1; }
	$(quiet)$(MAKE) --no-print-directory WERROR=-Werror run-tests

test-inputs: $(TEST_INPUTS)

# What shell tests find in their environment.
export BUILD CC
# Of the make that runs the tests alone: the one that set up the machine may have looked for clang before it was there.
run-tests: export LANES := $(LANES)
run-tests: export LANE_CLANG := $(LANE_CLANG)
export GNOMON := $(BUILD)/gnomon
export EMBEDDED_DEPTHS TARGET_DEPTHS MINIMAL_DEPTHS REPORT_CHECKED
export REPORT_SCENES := $(GOLDEN_SCENES)

PROVE = prove --exec '' -j$$(nproc)

# The longest first, so that no processor waits for them at the end.
LONG_TESTS := tests/faults/faults.sh tests/hard/slow_move_test.sh $(foreach t,hard/hard host/volumes_truth_test host/point_truth_test \
	core/warped_map_test core/fit_depth_test core/silhouette_map_test core/receiver_test core/warp_table_test,\
	%/tests/$(t))
longest_first = $(foreach t,$(LONG_TESTS),$(filter $(t),$(1))) $(filter-out $(LONG_TESTS),$(1))

run-tests: test-inputs
	$(quiet)$(PROVE) $(call longest_first,$(TEST_PROGRAMS) $(SHELL_TESTS)) 2>&1 | tee $(BUILD)/prove.log
	$(quiet)GNOMON=$(BUILD)/checked-16/gnomon $(PROVE) $(filter tests/host/%,$(SHELL_TESTS)) 2>&1 | tee -a $(BUILD)/prove.log
	@awk -v expected_runs=2 -f tests/summary.awk $(BUILD)/prove.log

# ---- the rest ------------------------------------------------------------------------------------------------------

help: ## list the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-15s %s\n", $$1, $$2 }' $(firstword $(MAKEFILE_LIST))

clean: ## remove everything made
	rm -rf $(BUILD)

always:

.PHONY: all demo demo-pictures hashes accept-hashes bench-targets profile cost-model cost-model-errors report sizes test test-inputs run-tests help clean always
