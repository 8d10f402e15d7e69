#!/usr/bin/env bash
# scripts/hil/modules.sh FOLDER RELEASE: builds the drivers that Debian's kernel does not ship: gpio-sim and irq_sim
# (simulated lines), vimc (cameras for libcamera), v4l2loopback (a video device fed by a program), the DMA heaps with the
# system's heap (memory that cameras fill).
set -euo pipefail
FOLDER=$1 RELEASE=$2
DOWNLOADS=$FOLDER/downloads

# Headers: unpacked, not installed; their links point at places of an installed package.
HEADERS=$FOLDER/headers
rm -rf "$HEADERS" && mkdir "$HEADERS"
dpkg -x "$DOWNLOADS/linux-headers-$RELEASE"_*.deb "$HEADERS"
dpkg -x "$DOWNLOADS/linux-headers-${RELEASE%-amd64}-common"_*.deb "$HEADERS"
TREE=$HEADERS/usr/src/linux-headers-$RELEASE
COMMON=$HEADERS/usr/src/linux-headers-${RELEASE%-amd64}-common
for part in scripts tools; do
  ln -sfn "/usr/lib/linux-kbuild-6.1/$part" "$TREE/$part"
  ln -sfn "/usr/lib/linux-kbuild-6.1/$part" "$COMMON/$part"
done
sed -i "s|/usr/src/linux-headers-${RELEASE%-amd64}-common|$COMMON|" "$TREE/Makefile"

M=$FOLDER/modules
rm -rf "$M" && mkdir "$M"
T=$(mktemp -d)
trap 'rm -rf "$T"' EXIT
dpkg-deb --fsys-tarfile "$DOWNLOADS"/linux-source-6.1_*.deb | tar -xO ./usr/src/linux-source-6.1.tar.xz | xz -dc |
  tar -x -C "$T" --strip-components=1 linux-source-6.1/drivers/media/test-drivers/vimc \
    linux-source-6.1/drivers/gpio/gpio-sim.c linux-source-6.1/drivers/gpio/gpiolib{,-cdev}.h \
    linux-source-6.1/kernel/irq/irq_sim.c linux-source-6.1/drivers/dma-buf/{dma-heap.c,heaps/system_heap.c}
dpkg -x "$DOWNLOADS"/v4l2loopback-dkms_*.deb "$T/loopback"
cp "$T"/drivers/gpio/* "$T/kernel/irq/irq_sim.c" "$T"/drivers/dma-buf/{dma-heap.c,heaps/system_heap.c} "$T"/loopback/usr/src/v4l2loopback-*/v4l2loopback*.[ch] "$M"
cp -r "$T/drivers/media/test-drivers/vimc" "$M"

# irq_sim as a module: irq_to_desc() is not exported to modules.
sed -i 's/irq_to_desc(irqnum)/irq_data_to_desc(irq_get_irq_data(irqnum))/' "$M/irq_sim.c"
printf '#include <linux/module.h>\nMODULE_LICENSE("GPL");\n' >> "$M/irq_sim.c"
sed -i 's/\$(CONFIG_VIDEO_VIMC)/m/' "$M/vimc/Makefile"

# The DMA heaps are no module of their own in the kernel: one module of both files, whose heap comes after its class.
sed -i 's/^static int dma_heap_init(void)/int dma_heap_init(void);\nint dma_heap_init(void)/; /^subsys_initcall/d' "$M/dma-heap.c"
sed -i 's/^static int system_heap_create(void)/int dma_heap_init(void);\n&/
  s/^module_init(system_heap_create)/static int __init heaps_init(void)\n{\n\tint ret = dma_heap_init();\n\n\treturn ret ? ret : system_heap_create();\n}\nmodule_init(heaps_init)/' "$M/system_heap.c"
printf 'MODULE_IMPORT_NS(DMA_BUF);\n' >> "$M/system_heap.c"

# v4l2loopback holds exposure and gain: its reader sets them, its feeder reads them back.
controls=""
cases=""
for control in "EXPOSURE, 1, 65535, 1, 1000" "EXPOSURE_ABSOLUTE, 1, 65535, 1, 100" "ANALOGUE_GAIN, 0, 1023, 1, 16" \
  "GAIN, 0, 1023, 1, 16" "GAMMA, 1, 500, 1, 100"; do
  controls+="\tv4l2_ctrl_new_std(hdl, \&v4l2loopback_ctrl_ops, V4L2_CID_$control);\n"
  cases+="\tcase V4L2_CID_${control%%,*}:\n"
done
sed -i "s/^\tv4l2_ctrl_new_custom(hdl, &v4l2loopback_ctrl_timeoutimageio, NULL);/&\n$controls/" "$M/v4l2loopback.c"
sed -i "/^static int v4l2loopback_set_ctrl(/,/^}/ s/^\tswitch (id) {/&\n$cases\t\tbreak;/" "$M/v4l2loopback.c"

# vimc: as many cameras as n_devs says.
sed -i '/^static void vimc_dev_release/,/^};/d; /^static int __init vimc_init/,/^module_exit/d' "$M/vimc/vimc-core.c"
cat >> "$M/vimc/vimc-core.c" <<'X'
static unsigned int n_devs = 1;
module_param(n_devs, uint, 0444);
static struct platform_device *vimc_pdevs[8];
static void vimc_del(void)
{
	int i;

	for (i = 0; i < 8; i++)
		if (!IS_ERR_OR_NULL(vimc_pdevs[i]))
			platform_device_unregister(vimc_pdevs[i]);
}
static int __init vimc_init(void)
{
	int i;

	for (i = 0; i < n_devs && i < 8; i++) {
		vimc_pdevs[i] = platform_device_register_simple(VIMC_PDEV_NAME, i, NULL, 0);
		if (IS_ERR(vimc_pdevs[i])) {
			int e = PTR_ERR(vimc_pdevs[i]);

			vimc_del();
			return e;
		}
	}
	i = platform_driver_register(&vimc_pdrv);
	if (i)
		vimc_del();
	return i;
}
static void __exit vimc_exit(void)
{
	platform_driver_unregister(&vimc_pdrv);
	vimc_del();
}
module_init(vimc_init);
module_exit(vimc_exit);
X

printf 'obj-m += irq_sim.o gpio-sim.o v4l2loopback.o vimc/ dma_heaps.o\ndma_heaps-y := dma-heap.o system_heap.o\n' > "$M/Kbuild"
make -s -C "$TREE" M="$M" modules 2>&1 | grep -v BTF || true
UPDATES=$FOLDER/root/lib/modules/$RELEASE/updates
mkdir -p "$UPDATES"
cp "$M"/{irq_sim,gpio-sim,v4l2loopback,dma_heaps}.ko "$M/vimc/vimc.ko" "$UPDATES"
strip --strip-debug "$UPDATES"/*.ko
depmod -b "$FOLDER/root" "$RELEASE"
