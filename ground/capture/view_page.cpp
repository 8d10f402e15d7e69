#include "ground/capture/view_page.hpp"

namespace omma::ground {
namespace {

// Dark, because it is looked at beside a telescope; one camera a row on a phone, as many as fit elsewhere.
constexpr std::string_view kPage = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Omma: cameras</title>
<meta name="viewport" content="width=device-width,initial-scale=1">
<style>
:root{--ink:#e6ebf2;--soft:#93a1b5;--line:#2b3645;--paper:#0f141b;--card:#161d27;--good:#5cc98b;--bad:#ff6b81}
*{box-sizing:border-box}body{margin:0;background:var(--paper);color:var(--ink);font:15px/1.4 system-ui,sans-serif}
header{display:flex;flex-wrap:wrap;gap:8px 16px;align-items:center;padding:12px 16px;border-bottom:1px solid var(--line)}
h1{font-size:18px;margin:0;flex:1}header label{color:var(--soft);font-size:14px;display:flex;gap:6px;align-items:center;min-height:32px}
main{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(420px,100%),1fr));gap:14px;padding:14px;max-width:1800px;margin:0 auto}
section{background:var(--card);border:1px solid var(--line);border-radius:10px;overflow:hidden}
.view{display:block;width:100%;background:#000;cursor:zoom-in}
.text{padding:10px 14px 12px}h2{font-size:16px;margin:0 0 8px;display:flex;gap:8px;align-items:baseline}
h2 small{color:var(--soft);font-weight:400;font-size:13px}h2::before{content:"";width:9px;height:9px;border-radius:50%;background:var(--good);align-self:center}
.gone h2::before{background:var(--bad)}.gone .view{opacity:.35}
dl{display:grid;grid-template-columns:repeat(4,1fr);gap:8px;margin:0}dt{color:var(--soft);font-size:12px}
dd{margin:0;font-size:17px;font-variant-numeric:tabular-nums;white-space:nowrap}p{margin:8px 0 0;color:var(--soft);font-size:13px}
.bad{color:var(--bad)}#large{position:fixed;inset:0;background:#000;overflow:auto;display:none;cursor:zoom-out}#large.on{display:block}
#large img{display:block;image-rendering:pixelated}#quiet{display:none;background:var(--bad);color:#000;padding:6px 16px}
@media(max-width:480px){main{padding:8px;gap:8px}dl{grid-template-columns:repeat(2,1fr)}}
</style></head><body>
<header><h1>Omma: cameras</h1><label><input type="checkbox" id="stretch" checked>stretched</label></header>
<div id="quiet">The capture does not answer.</div>
<main></main><div id="large"><img alt="camera, its own pixels"></div>
<script>
'use strict';
const main=document.querySelector('main'),large=document.getElementById('large'),stretch=document.getElementById('stretch'),cards=new Map();let turns=0;
// Frame after frame, each asked for when the one before it is there: a slow link shows fewer, and none is old.
async function show(img,name,width,goes){const pause=ms=>new Promise(done=>setTimeout(done,ms));while(goes())try{
const r=await fetch('camera/'+encodeURIComponent(name)+'.jpg?width='+width()+'&stretch='+(stretch.checked?1:0));
if(!r.ok)throw r.status;const u=URL.createObjectURL(await r.blob()),old=img.src;img.src=u;await img.decode();if(old)URL.revokeObjectURL(old);await pause(20)}
catch(e){await pause(1000)}}
function add(c){const s=document.createElement('section');
s.innerHTML='<img class="view" alt=""><div class="text"><h2></h2><dl><div><dt>rate</dt><dd class="rate"></dd></div><div><dt>exposure</dt><dd class="exposure"></dd></div><div><dt>gain</dt><dd class="gain"></dd></div><div><dt>frames</dt><dd class="frames"></dd></div></dl><p></p></div>';
const card={name:c.name,section:s,img:s.querySelector('img')};card.img.style.aspectRatio=c.width+'/'+c.height;card.img.alt=c.name;
const h=s.querySelector('h2');h.textContent=c.name;const d=document.createElement('small');d.textContent=c.driver+', '+c.width+' × '+c.height;h.append(d);
card.img.onclick=()=>{const turn=++turns;large.classList.add('on');show(large.firstChild,c.name,()=>16384,()=>turn===turns)};
main.append(s);cards.set(c.name,card);
show(card.img,c.name,()=>Math.max(160,Math.round(card.img.clientWidth*Math.min(devicePixelRatio||1,2))),()=>true);return card}
function say(c){const card=cards.get(c.name)||add(c),t=(k,v)=>card.section.querySelector('.'+k).textContent=v,l=c.lost;
card.section.classList.toggle('gone',!c.connected||c.rate_hz===0&&c.frames>0);
t('rate',c.rate_hz.toFixed(1)+' Hz');t('exposure',c.exposure_ms>0?(c.exposure_ms<1?(c.exposure_ms*1000).toFixed(0)+' µs':c.exposure_ms.toFixed(1)+' ms'):'not told');
t('gain','× '+c.gain.toFixed(2));t('frames',c.frames.toLocaleString('en'));
const p=card.section.querySelector('p'),some=l.gaps+l.damaged+l.without_room+l.times_gone>0;p.classList.toggle('bad',some);
p.textContent=(c.connected?'':'gone, looked for. ')+(some?'lost: '+l.gaps+' gaps, '+l.damaged+' damaged, '+l.without_room+' without room; '+l.times_gone+' times gone':'nothing lost')+(c.written_mb>0?'; '+c.written_mb.toFixed(0)+' MB written':'')}
async function ask(){let well=true;try{const r=await fetch('status.json');(await r.json()).cameras.forEach(say)}catch(e){well=false}
document.getElementById('quiet').style.display=well?'none':'block';setTimeout(ask,1000)}
large.onclick=()=>{++turns;large.classList.remove('on');large.firstChild.removeAttribute('src')};
ask();
</script></body></html>
)";

}  // namespace

std::string_view view_page() {
  return kPage;
}

}  // namespace omma::ground
