#include "page_parts.h"

/* In pieces: C99 promises string literals of 4095 characters. */
static const char *const style[] = {
    ":root{color-scheme:light}\n"
    "*{box-sizing:border-box}\n"
    "body{margin:0 auto;max-width:1120px;padding:0 16px 48px;background:#fff;color:#1a1a1a;"
    "font:16px/1.5 system-ui,-apple-system,\"Segoe UI\",Roboto,\"Helvetica Neue\",Arial,\"Liberation Sans\",sans-serif;"
    "overflow-wrap:anywhere}\n"
    "h1{font-size:1.7rem;line-height:1.2;margin:28px 0 8px}\n"
    "h2{font-size:1.35rem;line-height:1.25;margin:44px 0 10px;padding-top:12px;border-top:2px solid #1a1a1a}\n"
    "h3{font-size:1.05rem;margin:26px 0 6px}\n"
    "p{margin:8px 0;max-width:46em}\n"
    "code{font:.86em/1.4 ui-monospace,Menlo,Consolas,\"Liberation Mono\",monospace;background:#f3f3f3;padding:1px "
    "4px}\n"
    ".small,figcaption,.legend,.columns,.chains{font-size:.84rem;line-height:1.45}\n"
    "a{color:#0050a0}\n"
    "nav ul,.legend{list-style:none;padding:0;display:flex;flex-wrap:wrap;gap:4px 18px;margin:10px 0}\n"
    "svg.sample{width:auto;height:14px;display:inline-block;vertical-align:-2px}\n"
    ".lead{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,420px),1fr));gap:8px "
    "28px;align-items:start}\n"
    ".picture{display:block;width:100%;max-width:640px;height:auto;border:1px solid #bbb}\n"
    ".advice{padding-left:1.2em;max-width:52em;margin:4px 0}.advice li{margin:5px 0}\n"
    "figure{margin:0;min-width:0;overflow-x:auto}\n"
    ".plots{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,440px),1fr));gap:18px 28px;margin:12px "
    "0}\n"
    ".front{width:100%;margin:6px 0}.front th[scope=row],.front "
    "th[scope=col]{white-space:normal;overflow-wrap:break-word}\n"
    ".front th[scope=col]{font-weight:bold;vertical-align:bottom}.front "
    "th:nth-child(2){text-align:left}\n"
    ".front td,.front th{padding:1px 5px}.front td:first-child{font-weight:bold}\n"
    ".crops{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,250px),1fr));gap:14px 18px;margin:10px "
    "0}\n"
    ".crops img{width:100%;height:auto;display:block;image-rendering:pixelated;border:1px solid #bbb}\n"
    ".key{display:inline-block;width:1em;height:1em;border:1px solid #555;vertical-align:-.1em;margin-right:3px}\n",
    ".rows{margin:12px 0}.rows label{margin:0 16px 0 4px;font-size:.84rem}\n"
    ".rows input[type=search]{font:inherit;font-size:.84rem;padding:2px 6px;border:1px solid "
    "#888;width:17em;max-width:100%}\n"
    ".box{overflow:auto;max-height:70vh;border:1px solid #bbb;margin-top:6px}\n"
    "table{border-collapse:separate;border-spacing:0;font-size:.8rem;line-height:1.35;font-variant-numeric:tabular-"
    "nums}\n"
    "td,th{padding:2px 8px;text-align:right;border-bottom:1px solid #e6e6e6;white-space:nowrap;font-weight:normal}\n"
    ".box th[scope=row]{text-align:left;position:sticky;left:0;background:#fff;border-right:1px solid #bbb}\n"
    ".box thead th{position:sticky;top:0;background:#f3f3f3;border-bottom:1px solid "
    "#888;vertical-align:bottom;z-index:1;"
    "white-space:normal}\n"
    ".box thead th:first-child{left:0;z-index:2;text-align:left}\n"
    "th button{all:unset;font-weight:bold;min-width:3.2em;overflow-wrap:normal}.js th button{cursor:pointer}\n"
    ".js th button:focus-visible{outline:2px solid #0050a0}\n"
    ".js th[aria-sort=ascending] button::after{content:\"\\2009\\25b2\"}\n"
    ".js th[aria-sort=descending] button::after{content:\"\\2009\\25bc\"}\n"
    "tr.f>th,tr.f>td{font-weight:bold}\n"
    ".fronts:checked~.box tbody tr:not(.f){display:none}\n"
    "tr.hidden{display:none}\n"
    ".columns,.chains{display:grid;grid-template-columns:max-content 1fr;gap:1px 14px;margin:8px 0}\n"
    ".columns dt,.chains dt{font-weight:bold}.columns dd,.chains dd{margin:0}\n"
    "@media(max-width:560px){body{padding:0 12px 32px}.columns,.chains{display:block}.columns dd,.chains dd{margin:0 0 "
    "5px}"
    ".box "
    ".front{font-size:.74rem}.front td,.front th{padding:1px 3px}.box "
    "th[scope=row]{min-width:8.5em;max-width:11em;white-space:normal;overflow-wrap:break-word}.crops{grid-template-"
    "columns:1fr}}\n"
    "@media print{body{max-width:none;font-size:10pt}.rows input,.rows "
    "label,nav{display:none}.box{max-height:none;overflow:visible;"
    "border:0}.box tbody tr:not(.f){display:none}section{break-before:page}figure,.crops figure{break-inside:avoid}}\n",
};

/* Sort by a click on a column's name, what is empty last in both directions; show the rows of some chains alone. */
static const char script[] =
    "document.documentElement.className='js';\n"
    "document.querySelectorAll('table.sort').forEach(function(table){\n"
    "  var body=table.tBodies[0],heads=table.querySelectorAll('thead th');\n"
    "  heads.forEach(function(head,column){\n"
    "    head.firstChild.onclick=function(){\n"
    "      var number=head.dataset.kind=='number',down=head.getAttribute('aria-sort')=='ascending';\n"
    "      heads.forEach(function(other){other.removeAttribute('aria-sort')});\n"
    "      head.setAttribute('aria-sort',down?'descending':'ascending');\n"
    "      Array.from(body.rows).map(function(row,place){\n"
    "        var text=row.cells[column].textContent;\n"
    "        return{row:row,place:place,empty:text=='',value:number?parseFloat(text):text};\n"
    "      }).sort(function(a,b){\n"
    "        if(a.empty||b.empty)return a.empty-b.empty||a.place-b.place;\n"
    "        var order=a.value<b.value?-1:a.value>b.value?1:0;\n"
    "        return(down?-order:order)||a.place-b.place;\n"
    "      }).forEach(function(entry){body.appendChild(entry.row)});\n"
    "    };\n"
    "  });\n"
    "  var field=document.createElement('input');\n"
    "  field.type='search';field.placeholder='chains with this in their name';\n"
    "  field.setAttribute('aria-label',field.placeholder);\n"
    "  field.oninput=function(){\n"
    "    Array.from(body.rows).forEach(function(row){\n"
    "      row.className=row.className.replace(' hidden','')+(row.cells[0].textContent.includes(field.value)?'':' "
    "hidden');\n"
    "    });\n"
    "  };\n"
    "  table.parentNode.before(field);\n"
    "});\n";

void page_write_style(FILE *stream)
{
    for (size_t i = 0; i < sizeof style / sizeof *style; i++)
        fputs(style[i], stream);
}

void page_write_script(FILE *stream)
{
    fputs(script, stream);
}
